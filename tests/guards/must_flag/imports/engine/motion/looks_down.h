#include "sim/random/stream.h"
