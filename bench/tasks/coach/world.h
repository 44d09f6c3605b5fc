#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/tasks/coach/options.h"
#include "engine/coaching/dance_library.h"
#include "engine/recognition/taught_move.h"
#include "sim/choreography/move.h"
#include "sim/performer/person.h"
#include "sim/performer/rendition.h"
#include "sim/random/stream.h"
#include "sim/skeleton_sensor/skeleton_sensor.h"

namespace etude {

/// The data that all worlds of a condition share: a song with its dance and its moves.
struct CoachStage {
  std::vector<Move> moves;                   ///< the moves, in the order of the dance, at the song's tempo
  std::vector<TaughtMove> taught;            ///< the same moves, as recognisers are taught them
  std::unique_ptr<ShowableFaults> showable;  ///< the faults that each move can have; never null
  std::unique_ptr<DanceLibrary> library;     ///< never null
  std::vector<double> natural_jumps_cm;      ///< natural jumps of the unbroken dance

  const Dance& dance() const { return library->dance(); }
};

/// Prepares a built-in song.
Result<CoachStage> SetCoachStage(const std::string& song);

/// One trial: the learner and the position of the sensor. All other random values of a session are drawn while it runs,
/// from streams keyed by the event (the n-th performance of a move) or by the frame. Every coach therefore meets the
/// same random events.
struct CoachWorld {
  WorldKey key;
  Person person;
  Camera sensor;
  SkeletonSensorOptions errors;
  Occluders occluders;
  /// Studio whose cameras replace the skeleton sensor; nullopt = the skeleton sensor.
  std::optional<StudioOptions> cameras = {};
  MusicClockOptions music;
  int frames = 0;  ///< length of the session, frames
  LearnerOptions learner;
  int test_after = 20;  ///< delay of the retention test, in durations of one performance
};

/// Makes the world of `key`. The scenario in `key` must outlive the world.
CoachWorld MakeCoachWorld(const CoachCondition& condition, const WorldKey& key);

}  // namespace etude
