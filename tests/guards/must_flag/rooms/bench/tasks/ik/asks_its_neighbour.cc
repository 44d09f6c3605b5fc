#include "bench/tasks/tracking/tracking_options.h"
