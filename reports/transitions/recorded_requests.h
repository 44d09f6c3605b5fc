#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/recordings/task_extras.h"
#include "engine/base/result.h"

namespace etude {

/// The contents of a transition's recording, with clips by the names that people use.
using TransitionFacts = TransitionExtras;
using PointFacts = TransitionExtras::Point;
using CandidateFacts = TransitionExtras::Candidate;

/// Reads what a recording tells of its transition; whatever it leaves out is empty. There is always a point, and
/// `transition_frames` rise and lie within the coach's motion: others are left out. Fails, naming `cell`, when the
/// extras are no JSON object.
Result<TransitionFacts> ReadTransitionFacts(const Recording& recording, const std::string& cell);

/// Names a clip as people do: "builtin:side_kick" is "side kick".
std::string ClipInWords(std::string name);

/// A method's transition at a request, as recorded.
struct RecordedTransition {
  const Row* row;
  const Recording* recording;
  TransitionFacts facts;
};

/// One request, and the recorded way of each method through it. Never empty.
struct RecordedRequest {
  std::vector<RecordedTransition> transitions;  ///< in the order of the scenario's methods

  /// Names the world: "trial 3", "threshold=0.3, trial 3".
  std::string Name() const;
  /// Names the clips: "clap → side kick".
  std::string Request() const;
};

/// Lists the worlds of a scenario of transitions with recordings that can be read, in the run's order; none for other
/// tasks. The run must outlive them.
std::vector<RecordedRequest> RecordedRequestsOf(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
