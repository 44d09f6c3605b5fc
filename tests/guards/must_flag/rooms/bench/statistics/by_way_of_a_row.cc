// Allowed by itself; but the header beside includes a task.
#include "bench/model/row.h"
