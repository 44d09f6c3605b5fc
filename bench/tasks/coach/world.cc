#include "bench/tasks/coach/world.h"

#include <cmath>

#include "bench/tasks/detection/occluders.h"
#include "engine/base/angles.h"

namespace etude {

CoachWorld MakeCoachWorld(const CoachCondition& condition, const WorldKey& key) {
  // The distance at which Kinect's makers ask players to stand, roughly.
  constexpr double kNearest = 2.5, kFarthest = 3.0;
  RandomStream place_dice(key, "sensor-place");
  const double thrown = place_dice.Uniform(kNearest, kFarthest);
  const DetectionOptions& sight = condition.sight;
  const SensorPlace place{
      .distance = sight.distance_m.value_or(thrown), .turn = Radians(sight.turn_deg), .height = sight.sensor_height_m};
  CoachWorld world{.key = key,
                   .person = DrawPerson(key, sight.session.people),
                   .sensor = SkeletonSensorAt(place, sight.sensor.view),
                   .errors = sight.sensor,
                   .occluders = {},
                   .music = condition.music,
                   .frames = static_cast<int>(std::lround(condition.session_s * kJudgedRateHz)),
                   .learner = condition.learner};
  if (sight.has_cameras) world.cameras = sight.cameras.studio;
  world.errors.strength = sight.noise;
  world.occluders = MakeOccluders(sight.occluder, place, static_cast<std::size_t>(world.frames));
  return world;
}

}  // namespace etude
