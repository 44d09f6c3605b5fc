#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>

#include "engine/keypoints/keypoint_motion.h"

namespace etude {

/// The direction opposite to gravity.
struct FoundUp {
  glm::dvec3 up;
  double deviation = 0;  ///< standard deviation in radians, along the axis in which the direction is least certain
  double within = 0;     ///< angle from the true direction that is not exceeded in 95 of 100 takes, radians
  std::string by;        ///< the main evidence, e.g. "the cameras' horizons and resting feet"
};

/// Finds the up direction from several cues *(ours)*. It minimises a sum of robust squared residuals (Student's t,
/// ν = 4) by Gauss–Newton steps from many start directions. The figures with ± are the scales of the residuals.
/// - **Cameras** are mounted level: a picture's rows are horizontal ± 3° (as in nerfstudio's `vertical` orientation of
///   camera poses); cameras look down by 10° ± 20°. A picture rotated by quarter turns adds a fixed cost.
/// - **Resting feet** stand on one level floor: landmarks of one kind have the same height, ± 0.8 % of the stature;
///   ankles, heels and toes differ by the heights of a flat foot, ± 1.5 %. Outliers (a foot on a chair, or on its
///   toes) are ignored. Hips below the feet add a fixed cost.
/// - **A straight person** (the distance from ankles to shoulders is the length of legs and trunk) stands upright,
///   ± 6°; a lying person adds a fixed cost.
/// - **In a flight** gravity accelerates the body's centre of mass, ± 3°: a flight is at least 0.2 s in which a
///   parabola fits with an acceleration within 15 % of 9.81 m/s².
/// `deviation` is enlarged if the cues disagree by more than these scales. If another direction explains the cues
/// nearly as well, `within` is at least the angle to that direction. Other postures are not used as cues.
/// @param metre the length of a metre in the points' unit
FoundUp FindUp(std::span<const NamedCamera> cameras, std::span<const LandmarkPositions> points, double rate_hz,
               double stature, double metre);

}  // namespace etude
