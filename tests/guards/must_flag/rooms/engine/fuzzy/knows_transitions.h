// Transitions are made of distances, not the other way round.
#pragma once
#include "engine/cameras/camera.h"
