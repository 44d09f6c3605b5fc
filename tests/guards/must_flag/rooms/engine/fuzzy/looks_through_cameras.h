// Pose features are of a body, however it was seen.
#pragma once
#include "engine/cameras/camera.h"
