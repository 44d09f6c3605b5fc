#include "bench/run/run.h"
