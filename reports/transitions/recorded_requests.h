#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/recordings/task_extras.h"
#include "engine/base/result.h"

namespace etude {

/// The extras of a transition's recording, with clip names in readable form (ClipInWords).
using TransitionFacts = TransitionExtras;
using PointFacts = TransitionExtras::Point;
using CandidateFacts = TransitionExtras::Candidate;

/// Reads the extras of a recorded transition. Members that the recording does not contain are empty. The result has at
/// least one transition point. `transition_frames` are ascending; frames outside the coach's motion are dropped. Fails,
/// naming `cell`, if the extras are not a JSON object.
Result<TransitionFacts> ReadTransitionFacts(const Recording& recording, const std::string& cell);

/// Returns a clip's name in readable form: "builtin:side_kick" becomes "side kick".
std::string ClipInWords(std::string name);

/// The transition that one method made for a request, and its recording.
struct RecordedTransition {
  const Row* row;
  const Recording* recording;
  TransitionFacts facts;
};

/// A request to change clips in one world, with the recorded transition of each method. There is at least one
/// transition.
struct RecordedRequest {
  std::vector<RecordedTransition> transitions;  ///< transitions in the order of the scenario's methods

  /// Returns the name of the world: "trial 3", "threshold=0.3, trial 3".
  std::string Name() const;
  /// Returns the playing clip and the wanted clip: "clap → side kick".
  std::string Request() const;
};

/// Lists the requests of a transition scenario that have readable recordings, one per world, in the run's order; empty
/// for other tasks. The run must outlive the result.
std::vector<RecordedRequest> RecordedRequestsOf(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
