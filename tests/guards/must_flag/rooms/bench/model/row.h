// What every room includes must not know a task: whoever includes this header is flagged as well.
#pragma once
#include "bench/tasks/base/task.h"
