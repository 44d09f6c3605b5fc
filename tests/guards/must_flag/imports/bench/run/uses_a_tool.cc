#include "tools/capture.h"
