#include "bench/model/row.h"
