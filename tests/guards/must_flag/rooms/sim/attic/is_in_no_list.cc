// This folder is not a room, because it has no CMakeLists.txt.
#include "engine/base/angles.h"
