// Rows must not include the code that writes them.
#include "bench/results/row_json.h"
