#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/recordings/task_extras.h"
#include "engine/base/result.h"

namespace etude {

/// The content of a transition's recording, with clip names in the form for people (ClipInWords).
using TransitionFacts = TransitionExtras;
using PointFacts = TransitionExtras::Point;
using CandidateFacts = TransitionExtras::Candidate;

/// Reads the facts of a recorded transition; facts that the recording does not contain are empty. There is always at
/// least one transition point. `transition_frames` are ascending; frames outside the coach's motion are dropped. Fails,
/// naming `cell`, if the extras are no JSON object.
Result<TransitionFacts> ReadTransitionFacts(const Recording& recording, const std::string& cell);

/// Returns a clip's name in the form for people: "builtin:side_kick" becomes "side kick".
std::string ClipInWords(std::string name);

/// The recorded transition that one method made for a request.
struct RecordedTransition {
  const Row* row;
  const Recording* recording;
  TransitionFacts facts;
};

/// One request with the recorded transition of each method. There is at least one transition.
struct RecordedRequest {
  std::vector<RecordedTransition> transitions;  ///< in the order of the scenario's methods

  /// Returns the name of the world: "trial 3", "threshold=0.3, trial 3".
  std::string Name() const;
  /// Returns the clips: "clap → side kick".
  std::string Request() const;
};

/// Lists the worlds of a transition scenario that have readable recordings, in the run's order; empty for other tasks.
/// The run must outlive the result.
std::vector<RecordedRequest> RecordedRequestsOf(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
