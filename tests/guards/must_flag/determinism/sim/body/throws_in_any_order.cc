#include "sim/random/stream.h"

namespace etude {

glm::dvec2 Thrown(RandomStream& dice) { return glm::dvec2(dice.Normal(), dice.Normal()); }

}  // namespace etude
