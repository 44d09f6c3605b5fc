#include "bench/tasks/detection/occluders.h"

#include <cassert>
#include <cmath>

#include "engine/base/angles.h"
#include "sim/choreography/move.h"

namespace etude {
namespace {

/// A box whose middle lies `ahead` metres from the performer towards the sensor and `aside` across, facing the sensor.
Cuboid BoxBefore(const SensorPlace& sensor, double ahead, double aside, double height, const glm::dvec3& half_size) {
  const double sine = std::sin(sensor.turn), cosine = std::cos(sensor.turn);
  return {.centre = {ahead * sine + aside * cosine, height, ahead * cosine - aside * sine},
          .half_size = half_size,
          .heading = sensor.turn};
}

std::vector<BodyPose> Bystander(const SensorPlace& sensor, std::size_t frames) {
  const auto sway = LoadBuiltinMove("sway");
  assert(sway);  // built in
  const Cuboid place = BoxBefore(sensor, 1.2, 0.35, 0, glm::dvec3(1));
  const FloorMove move{.yaw = sensor.turn + Radians(90), .x = place.centre.x, .z = place.centre.z};
  std::vector<BodyPose> poses;
  for (std::size_t t = 0; t < frames; ++t) {
    poses.push_back(move.Apply(sway->motion.poses[t % sway->motion.poses.size()]));
  }
  return poses;
}

}  // namespace

Occluders MakeOccluders(OccluderKind kind, const SensorPlace& sensor, std::size_t frames) {
  switch (kind) {
    case OccluderKind::kNone:
      return {};
    case OccluderKind::kTable:
      return {.furniture = {BoxBefore(sensor, 0.8, 0, 0.73, {0.6, 0.02, 0.35}),
                            BoxBefore(sensor, 1.1, 0, 0.37, {0.6, 0.37, 0.02})},
              .bystander = {}};
    case OccluderKind::kChair:
      return {.furniture = {BoxBefore(sensor, 0.7, 0.2, 0.45, {0.22, 0.03, 0.22}),
                            BoxBefore(sensor, 0.9, 0.2, 0.68, {0.22, 0.22, 0.02})},
              .bystander = {}};
    case OccluderKind::kPerson:
      return {.furniture = {}, .bystander = Bystander(sensor, frames)};
  }
  return {};
}

}  // namespace etude
