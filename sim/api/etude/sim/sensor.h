#pragma once

#include <etude/recognition.h>

#include <cstdint>
#include <string>

/// Sensors that watch a body whose motion is known (docs/library.md).
namespace etude::sim {

/// A Kinect-like sensor and its position. The same options and motion give the same skeletons on every machine.
struct SensorOptions {
  std::string sensor = "v2";  ///< "v1", "v2", or the text of a sensor file, as `etude sensor fit` writes it
  /// Multiplies every error and probability, 0 to 10. At 0, hidden joints are inferred correctly.
  double strength = 1;
  double distance_m = 2.75;  ///< distance of the sensor from the middle of the motion, along the floor; 0.5 to 10
  double turn = 0;           ///< direction from the middle of the motion to the sensor, radians; 0 is +Z, π/2 is +X
  double height_m = 1;       ///< height, 0.1 to 3; the sensor looks at a point one metre above the middle of the motion
  std::uint64_t seed = 1;    ///< the seed of all random numbers
};

/// Returns the skeletons that a sensor measures while it watches a body with this motion: one per frame, positions in
/// the world. Throws BadInput for options out of range, a motion without frames, a rate that is not positive, and
/// positions that are not finite.
ETUDE_API SkeletonStream SenseSkeleton(const BodyMotion& motion, const SensorOptions& options = {});

}  // namespace etude::sim
