#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "reports/transitions/transition_facts.h"

namespace etude {

/// The recorded way of one method through a request.
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

/// Collects the worlds of a scenario of transitions with recordings that can be read, in the run's order; none for
/// other tasks. The run must outlive them.
std::vector<RecordedRequest> RecordedRequestsOf(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
