#pragma once

#include <optional>

#include "bench/recordings/task_extras.h"
#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "reports/films/cast.h"

namespace etude {

/// A recorded session of a coach, as a film needs it: what the recording tells, every frame of it within the session,
/// and its tracks.
struct CoachedSessionFacts : CoachExtras {
  BodyMotion coach, learner, sensed;  ///< of one length

  int Frames() const { return static_cast<int>(coach.poses.size()); }
};

/// Reads what the coach task keeps of a cell. Fails, naming the recording and the key, when it is not that.
Result<CoachedSessionFacts> ReadCoachedSession(const CastCell& cell);

/// Chooses the worst of a scenario's recorded sessions: the one with the most needless and missed corrections a minute.
/// Gives nothing where nothing was recorded.
std::optional<CastCell> ChooseWorstSession(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
