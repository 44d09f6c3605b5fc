// A room that the table does not have.
#include "engine/base/angles.h"
