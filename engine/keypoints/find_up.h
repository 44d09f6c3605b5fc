#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>

#include "engine/cameras/pose2sim_file.h"
#include "engine/keypoints/keypoint_motion.h"

namespace etude {

/// A direction of gravity, against it.
struct FoundUp {
  glm::dvec3 up;
  double deviation = 0;  ///< standard deviation in the worse direction, radians
  double within = 0;     ///< the truth is within this angle in 95 of 100 takes, radians
  std::string by;        ///< the evidence: "the cameras' horizons and resting feet"
};

/// Finds which way is up from several witnesses *(ours)*, as the direction of the least sum of robust squared residuals
/// (Student's t, ν = 4), by Gauss-Newton from many beginnings:
/// - **Cameras** are mounted level: a picture's rows are horizontal to 3° (as in nerfstudio's `vertical` orientation of
///   camera poses); cameras look down by 10° ± 20°. A camera may be turned by quarter turns, at a cost.
/// - **Resting feet** are on one level floor: equal landmarks at one height, to 0.8 % of the stature; ankles, heels and
///   toes differ by the heights of a flat foot, to 1.5 %. What is far off (a foot on a chair, on its toes) is ignored.
/// - **A straight person** (shoulders as far from the ankles as trunk and legs are long) stands, to 6°; lies, at a
/// cost.
/// - **In a flight** the body's centre of mass is accelerated by gravity, to 3°: at least 0.2 s in which a parabola
/// fits
///   and its acceleration is within 15 % of 9.81 m/s².
/// The deviation is that of the solution, enlarged if the witnesses disagree by more than they should; if another
/// direction explains them nearly as well, `within` reaches to it. How a person holds themself is no witness otherwise.
/// @param metre length of a metre in the points' unit
FoundUp FindUp(std::span<const NamedCamera> cameras, std::span<const LandmarkPositions> points, double rate_hz,
               double stature, double metre);

}  // namespace etude
