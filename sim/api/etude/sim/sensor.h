#pragma once

#include <etude/recognition.h>

#include <cstdint>
#include <string>
#include <vector>

/// Sensors that watch a body whose motion is known (docs/library.md).
namespace etude::sim {

/// A Kinect-like sensor, and where it stands. The same options and motion give the same reports, on every machine.
struct SensorOptions {
  std::string sensor = "v2";  ///< "v1" or "v2"; else the text of a sensor file, as `etude sensor fit` writes it
  double strength = 1;        ///< times every error and chance, 0 to 10; 0: what is hidden is inferred rightly
  double distance_m = 2.75;   ///< from the middle of where the body moves, along the floor; 0.5 to 10
  double turn = 0;            ///< radians about that middle; 0: on its +Z side, π/2: on its +X side
  double height_m = 1;        ///< above the floor, 0.1 to 3; it looks at the middle a metre above the floor
  std::uint64_t seed = 1;     ///< of every die
};

/// Returns what the sensor would have reported of a body that moves so: a report a frame, places in the world. Throws
/// BadInput for options out of range, a motion without frames, a rate that is none, and places that are not finite.
ETUDE_API std::vector<engine::SensedPose> SenseSkeleton(const engine::Motion& motion,
                                                        const SensorOptions& options = {});

}  // namespace etude::sim
