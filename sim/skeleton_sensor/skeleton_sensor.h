#pragma once

#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "engine/recognition/skeleton_stream.h"
#include "sim/random/stream.h"
#include "sim/skeleton_sensor/options.h"
#include "sim/skeleton_sensor/visibility.h"

namespace etude {

/// Where a sensor stands: in front of a performer who is at the origin facing +Z.
struct SensorPlace {
  double distance = 2.75;  ///< metres on the floor
  double turn = 0;         ///< radians: the performer is seen turned by so much
  double height = 1.0;     ///< metres above the floor; it looks at the performer a metre above the floor
};
Camera SkeletonSensorAt(const SensorPlace& place, const Intrinsics& view);

/// What `sensor` would report of a body moving as `truth`: one frame per frame, late by the options' lag. A joint is
/// inferred while something stands before it, not tracked while out of view. Every error has dice of its own, and as
/// many throws per frame whatever happens, so that options change strengths and nothing else.
SkeletonStream SenseSkeleton(const BodyMotion& truth, const Camera& sensor, const Occluders& occluders,
                             const SkeletonSensorOptions& options, const WorldKey& world);

}  // namespace etude
