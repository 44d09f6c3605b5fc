#pragma once

#include <etude/base.h>

#include "engine/vision/person_finder.h"
