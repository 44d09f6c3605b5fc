#pragma once

#include <optional>
#include <string>

#include "bench/tasks/coach/options.h"
#include "sim/performer/person.h"
#include "sim/random/stream.h"
#include "sim/skeleton_sensor/skeleton_sensor.h"

namespace etude {

/// One trial: who learns, and where the sensor stands. All else that is true of a session is thrown while it runs, by
/// dice that are keyed by what happens (a move's how manieth performance) and by the frame, so that every coach meets
/// the same luck.
struct CoachWorld {
  WorldKey key;
  Person person;
  Camera sensor;
  SkeletonSensorOptions errors;
  Occluders occluders;
  std::optional<StudioOptions> cameras = {};  ///< in place of the skeleton sensor
  MusicClockOptions music;
  int frames = 0;  ///< of the session
  LearnerOptions learner;
  int test_after = 20;  ///< this many performances' time after the session, what was kept is tested
};

/// `key`'s scenario must outlive the world.
CoachWorld MakeCoachWorld(const CoachCondition& condition, const WorldKey& key);

}  // namespace etude
