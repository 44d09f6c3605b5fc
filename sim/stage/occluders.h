#pragma once

#include <vector>

#include "sim/body/box.h"
#include "sim/render/interior.h"

namespace etude {

/// The furniture as boxes that rays meet (HitDistance): what hides people from sensors other than cameras.
std::vector<Box> BoxesOf(const Interior& interior);

}  // namespace etude
