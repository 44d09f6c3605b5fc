// The lowest room knows no other.
#include "engine/motion/body.h"
