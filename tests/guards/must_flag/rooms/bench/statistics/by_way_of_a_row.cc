// This include is allowed, but bench/model/row.h includes a task.
#include "bench/model/row.h"
