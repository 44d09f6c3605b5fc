#pragma once

#include <glm/glm.hpp>

#include "sim/choreography/controls.h"

namespace etude {

/// The joints of one leg of the canonical body, metres.
struct LegJoints {
  glm::dvec3 hip, knee, ankle, toe;
};

/// The leg below `hip`. Standing, its foot is on its spot whatever the hips do; free, it follows its
/// angles in the pelvis' frame; in between, the ankle goes from one to the other. A spot out of reach
/// stretches the leg towards it.
LegJoints PlaceLeg(const Controls& controls, Side side, const glm::dmat3& pelvis, const glm::dvec3& hip);

/// The greatest height of a hip above which the standing leg, nearly straight, loses its spot; grows
/// out of the way as the leg becomes free. Only x and z of `hip` count.
double HighestHip(const Controls& controls, Side side, const glm::dvec3& hip);

}  // namespace etude
