#include "bench/tasks/detection/world.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "bench/metrics/detection.h"
#include "bench/tasks/detection/occluders.h"
#include "bench/tasks/sensing/camera_stream.h"
#include "engine/base/angles.h"
#include "engine/base/named.h"
#include "sim/skeleton_sensor/skeleton_sensor.h"

namespace etude {
TaughtMove TaughtOf(const Move& move) {
  constexpr double kForTheSlow = 0.5;  // seconds beyond one performance at the taught tempo
  TaughtMove taught{.name = move.name,
                    .span_s = 60.0 * move.beats / move.tempo_bpm + kForTheSlow,
                    .examples = {StreamOf(move.motion)}};
  for (const KeyPose& key_pose : move.key_poses) {
    TaughtPose& pose = taught.poses.emplace_back();
    for (const KeyPose::Target& target : key_pose.targets) {
      const Feature* feature = FindFeature(target.feature);
      assert(feature != nullptr);  // checked where choreography files are read
      pose.targets.push_back({*feature, target.degrees, target.tolerance_deg});
    }
  }
  return taught;
}

Repertoire RepertoireOf(const ClipLibrary& library) {
  Repertoire repertoire;
  for (const LibraryClip& clip : library.clips) {
    if (!clip.move || clip.move->key_poses.empty() || FindByName(repertoire.moves, clip.move->name)) continue;
    repertoire.moves.push_back(*clip.move);
    repertoire.taught.push_back(TaughtOf(*clip.move));
  }
  std::ranges::sort(repertoire.taught, {}, &TaughtMove::name);
  return repertoire;
}

std::size_t Repertoire::IndexOf(std::string_view move) const {
  const TaughtMove* found = FindByName(taught, move);
  assert(found != nullptr);
  return static_cast<std::size_t>(found - taught.data());
}

DetectionWorld MakeDetectionWorld(const Repertoire& repertoire, const DetectionOptions& options, const WorldKey& key) {
  RandomStream plan_dice(key, "session-plan");
  RandomStream dance_dice(key, "session-dance");
  RandomStream place_dice(key, "sensor-place");
  const Person person = DrawPerson(key, options.session.people);
  const SessionPlan plan = PlanSession(plan_dice, repertoire.moves, person, options.session);
  DetectionWorld world;
  world.session = Perform(dance_dice, repertoire.moves, person, plan);

  if (options.has_cameras) {
    world.cameras = std::make_shared<CameraTake>(options.cameras, world.session.motion, key);
    world.stream.frames.resize(world.session.motion.poses.size());
    return world;
  }
  // The distance at which Kinect's makers ask players to stand, roughly.
  constexpr double kNearest = 2.5, kFarthest = 3.0;
  SkeletonSensorOptions errors = options.sensor;
  errors.strength = options.noise;
  const double thrown = place_dice.Uniform(kNearest, kFarthest);
  const SensorPlace place{.distance = options.distance_m.value_or(thrown),
                          .turn = Radians(options.turn_deg),
                          .height = options.sensor_height_m};
  const Occluders occluders = MakeOccluders(options.occluder, place, world.session.motion.poses.size());
  world.stream = SenseSkeleton(world.session.motion, SkeletonSensorAt(place, errors.view), occluders, errors, key);
  return world;
}

FrameInterval WindowOf(const SessionEvent& event, const SkeletonStream& stream) {
  return FramesBetween(event.start_s, event.WindowEnd(), stream);
}

bool IsPerformance(std::string_view move, int frame, const DetectionWorld& world) {
  std::vector<MoveWindow> windows;
  for (const SessionEvent& event : world.session.events) {
    const FrameInterval window = WindowOf(event, world.stream);
    windows.push_back({event.move, event.danced, window.begin, window.end});
  }
  return !IsFalseAlarm(move, frame, windows);
}

}  // namespace etude
