// The lowest room, engine/base, must not include any other room.
#include "engine/motion/body.h"
