// A file that the guard `rooms` must flag: the model of rows must not include the code that writes them.
#include "bench/results/row_json.h"
