#pragma once

#include <vector>

#include "sim/body/cuboid.h"
#include "sim/render/interior.h"

namespace etude {

/// The furniture as boxes that rays meet (HitDistance): what hides people from sensors other than cameras.
std::vector<Cuboid> BoxesOf(const Interior& interior);

}  // namespace etude
