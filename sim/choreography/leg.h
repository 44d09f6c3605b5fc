#pragma once

#include <glm/glm.hpp>

#include "sim/choreography/canonical_body.h"
#include "sim/choreography/controls.h"

namespace etude {

/// The joints of one leg, metres.
struct LegJoints {
  glm::dvec3 hip, knee, ankle, toe;
};

/// The leg below `hip`; the metres of `controls` are this body's. Standing, its foot is on its spot whatever the hips
/// do; free, it follows its angles in the pelvis' frame; in between, the ankle goes from one to the other. A spot out
/// of reach stretches the leg towards it.
LegJoints PlaceLeg(const Controls& controls, const BodyDimensions& body, Side side, const glm::dmat3& pelvis,
                   const glm::dvec3& hip);

/// The greatest height of a hip above which the standing leg, nearly straight, loses its spot; grows
/// out of the way as the leg becomes free. Only x and z of `hip` count.
double HighestHip(const Controls& controls, const BodyDimensions& body, Side side, const glm::dvec3& hip);

}  // namespace etude
