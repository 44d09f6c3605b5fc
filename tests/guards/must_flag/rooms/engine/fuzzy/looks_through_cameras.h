// Pose features depend on the body alone, so they must not include cameras.
#pragma once
#include "engine/cameras/camera.h"
