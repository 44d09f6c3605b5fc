#include "bench/tasks/ik/ik_options.h"
