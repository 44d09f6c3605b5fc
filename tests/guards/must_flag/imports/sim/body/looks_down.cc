#include "bench/tasks/base/task.h"
