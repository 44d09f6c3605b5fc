// Rows do not know how they are written.
#include "bench/results/row_json.h"
