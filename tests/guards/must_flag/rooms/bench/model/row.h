// Many rooms include this header, so it must not include a task. Files that include it are flagged as well.
#pragma once
#include "bench/tasks/base/task.h"
