#include "bench/tasks/detection/world.h"

#include <cassert>
#include <cmath>

#include "engine/base/angles.h"
#include "sim/sensors/skeleton_sensor.h"

namespace etude {
namespace {

TaughtMove Teach(const Move& move) {
  TaughtMove taught{.name = move.name, .poses = {}};
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

/// One performance at the taught tempo, and half a second for the slow.
int SpanFrames(const Move& move) {
  const double seconds = 60.0 * move.beats / move.tempo_bpm + 0.5;
  return static_cast<int>(std::ceil(seconds * kJudgedRateHz));
}

}  // namespace

Repertoire RepertoireOf(const ClipLibrary& library) {
  Repertoire repertoire;
  for (const LibraryClip& clip : library.clips) {
    if (!clip.move || clip.move->key_poses.empty() || repertoire.taught.contains(clip.move->name)) continue;
    repertoire.taught[clip.move->name] = Teach(*clip.move);
    repertoire.span_frames[clip.move->name] = SpanFrames(*clip.move);
    repertoire.moves.push_back(*clip.move);
  }
  return repertoire;
}

DetectionWorld MakeDetectionWorld(const Repertoire& repertoire, const DetectionOptions& options, const WorldKey& key) {
  RandomStream plan_dice(key, "session-plan");
  RandomStream dance_dice(key, "session-dance");
  RandomStream place_dice(key, "sensor-place");
  const SessionPlan plan = PlanSession(plan_dice, repertoire.moves, options.session);
  DetectionWorld world;
  world.session = Perform(dance_dice, repertoire.moves, plan, options.session);

  // The distance at which Kinect's makers ask players to stand, roughly.
  constexpr double kNearest = 2.5, kFarthest = 3.0;
  const Camera sensor = SkeletonSensorAt(place_dice.Uniform(kNearest, kFarthest), Radians(options.turn_deg));
  SkeletonSensorOptions errors;
  errors.strength = options.noise;
  world.stream = SenseSkeleton(world.session.motion, sensor, errors, key);
  return world;
}

}  // namespace etude
