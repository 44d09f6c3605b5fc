#include "bench/tasks/detection/world.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "bench/metrics/detection.h"
#include "bench/tasks/sensing/camera_stream.h"
#include "engine/base/angles.h"
#include "engine/base/named.h"
#include "sim/choreography/dance_of.h"
#include "sim/choreography/move.h"

namespace etude {
namespace {

/// Returns a box that faces the sensor. Its centre is `ahead` metres from the performer towards the sensor and `aside`
/// metres to the side.
Cuboid BoxBefore(const SensorPlacement& sensor, double ahead, double aside, double height, const glm::dvec3& half_size) {
  const double sine = std::sin(sensor.turn), cosine = std::cos(sensor.turn);
  return {.centre = {ahead * sine + aside * cosine, height, ahead * cosine - aside * sine},
          .half_size = half_size,
          .heading = sensor.turn};
}

std::vector<BodyPose> Bystander(const SensorPlacement& sensor, std::size_t frames) {
  const auto sway = LoadBuiltinMove("sway");
  assert(sway);  // sway is a built-in move
  const Cuboid place = BoxBefore(sensor, 1.2, 0.35, 0, glm::dvec3(1));
  const FloorMove move{.yaw = sensor.turn + Radians(90), .x = place.centre.x, .z = place.centre.z};
  std::vector<BodyPose> poses;
  for (std::size_t t = 0; t < frames; ++t) {
    poses.push_back(move.Apply(sway->motion.poses[t % sway->motion.poses.size()]));
  }
  return poses;
}

}  // namespace

Occluders MakeOccluders(OccluderKind kind, const SensorPlacement& sensor, std::size_t frames) {
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

Repertoire RepertoireOf(const ClipLibrary& library) {
  Repertoire repertoire;
  for (const LibraryClip& clip : library.clips) {
    if (!clip.move || clip.move->key_poses.empty() || FindByName(repertoire.moves, clip.move->name)) continue;
    repertoire.moves.push_back(*clip.move);
    repertoire.taught.push_back(TaughtOf(*clip.move));
  }
  std::ranges::sort(repertoire.taught, {}, &TaughtMove::name);
  repertoire.names = NamesOf(repertoire.taught);
  return repertoire;
}

std::size_t Repertoire::IndexOf(std::string_view move) const {
  const auto found = std::ranges::find(names, move);
  assert(found != names.end());
  return static_cast<std::size_t>(found - names.begin());
}

std::optional<std::size_t> Repertoire::TaughtIndexOf(std::string_view move) const {
  const TaughtMove* found = FindByName(taught, move);
  if (found == nullptr) return std::nullopt;
  return static_cast<std::size_t>(found - taught.data());
}

bool DetectionEvent::HasFault() const {
  return !labelled_fault.empty() ||
         std::ranges::any_of(faults, [](const GradedFault& fault) { return fault.severity > 0; });
}

std::string DetectionEvent::FaultText() const { return labelled_fault.empty() ? FaultNames(faults) : labelled_fault; }

std::vector<FrameInterval> DetectionWorld::Takes() const {
  std::vector<FrameInterval> takes{{0, static_cast<int>(stream.frames.size())}};
  for (const int start : starts) {
    takes.back().end = start;
    takes.push_back({start, static_cast<int>(stream.frames.size())});
  }
  return takes;
}

SkeletonStream Sense(const BodyMotion& motion, const DetectionOptions& options, const WorldKey& key) {
  // This is about the distance at which Kinect's makers ask players to stand, metres.
  constexpr double kMinDistance = 2.5, kMaxDistance = 3.0;
  RandomStream place_dice(key, "sensor-place");
  SkeletonSensorOptions errors = options.sensor;
  errors.strength = options.noise;
  const double drawn = place_dice.Uniform(kMinDistance, kMaxDistance);
  const SensorPlacement place{.distance = options.distance_m.value_or(drawn),
                          .turn = Radians(options.turn_deg),
                          .height = options.sensor_height_m};
  const Occluders occluders = MakeOccluders(options.occluder, place, motion.poses.size());
  return SenseSkeleton(motion, SkeletonSensorAt(place, errors.view), occluders, errors, key);
}

DetectionEvent EventOf(const SessionEvent& event, const SkeletonStream& stream) {
  return {.move = event.move,
          .faults = event.faults,
          .danced = event.danced,
          .start_s = event.start_s,
          .end_s = event.end_s,
          .performed = FramesBetween(event.start_s, event.end_s, stream),
          .window = FramesBetween(event.start_s, event.WindowEnd(), stream),
          .truth = event.truth,
          .first_right_s = event.first_right_s};
}

DetectionWorld MakeDetectionWorld(const Repertoire& repertoire, const DetectionOptions& options, const WorldKey& key) {
  RandomStream plan_dice(key, "session-plan");
  RandomStream dance_dice(key, "session-dance");
  const Person person = DrawPerson(key, options.session.people);
  const SessionPlan plan = PlanSession(plan_dice, repertoire.moves, person, options.session);
  Performance session = Perform(dance_dice, repertoire.moves, person, plan);
  DetectionWorld world{.motion = std::move(session.motion), .events = {}, .stream = {}};
  if (options.has_cameras) {
    world.cameras = std::make_shared<CameraTake>(options.cameras, world.motion, key);
    world.stream.frames.resize(world.motion.poses.size());
  } else {
    world.stream = Sense(world.motion, options, key);
  }
  for (const SessionEvent& event : session.events) world.events.push_back(EventOf(event, world.stream));
  return world;
}

bool IsPerformance(std::string_view move, int frame, const DetectionWorld& world) {
  std::vector<MoveWindow> windows;
  for (const DetectionEvent& event : world.events) {
    windows.push_back({event.move, event.danced, event.window.begin, event.window.end});
  }
  constexpr double kAboutPoints = 0.5;  // half of the window around an action point, seconds
  for (const ActionPoint& point : world.points) {
    const auto margin = static_cast<int>(kAboutPoints * world.stream.rate_hz);
    windows.push_back({point.move, point.move, point.frame - margin, point.frame + margin + 1});
  }
  return !IsFalseAlarm(move, frame, windows);
}

}  // namespace etude
