#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/metrics/matching.h"
#include "bench/tasks/base/task.h"
#include "bench/tasks/transition/options.h"
#include "bench/tasks/transition/outcome.h"
#include "bench/tasks/transition/stage.h"
#include "bench/tasks/transition/world.h"
#include "bench/training/learnt_weights.h"
#include "engine/transitions/choices/choice.h"

namespace etude {

/// Counts the pairs of frames that a fuzzy choice may take, and those that its rules match.
MatchTally TallyMatches(const Stage& stage, const TransitionRequest& request, const TransitionWay& way);

/// The metrics of a transition that has a way (docs/reference/metrics.md), the worst transition point counting where an
/// in-between made two.
void ScoreTransition(const TransitionOutcome& outcome, const Stage& stage, CellResult& result);

/// The metrics of the pairs that a transition could have used; nothing for a method without a threshold.
void ScoreMatching(const std::optional<MatchTally>& tally, CellResult& result);

/// The ids of all metrics, in the order in which they are measured.
std::vector<std::string> TransitionMetrics();

/// The value of a metric for a method without a transition (Task::ValueOfFailure): 0 of `natural_share` and the other
/// shares of all cells. A transition that never came was not natural; left out of the count, a method could raise its
/// share by giving up where it is hard. Nothing for the rest: no number of centimetres stands for a jump that was not
/// made, and 0 of `false_smooth` would be praise.
std::optional<double> TransitionFailureValue(std::string_view metric);

/// Measures the metrics of ScoreTransition in a world in which no way was found.
void MeasureNoWay(CellResult& result);

/// The data that the runs of a task share; all of it must outlive them.
struct TransitionBasis {
  const std::vector<TransitionMethod>& methods;
  const Stage& stage;
  LearntWeights& learnt;  ///< remembers fits; what it answers depends on the question only
  double max_wait_s = 0;  ///< told to methods outside; built-in ones have their own
  bool explain = false;   ///< whether every cell keeps its explanation
};

/// One request on the task's stage, and what methods make of it.
class TransitionRun final : public TaskWorld {
 public:
  /// A request that failed is to be skipped.
  TransitionRun(const TransitionBasis& basis, Result<TransitionRequest> request, bool keeps_motion);

  std::optional<std::string> WhySkipped() const override;
  void PrepareShared() override;
  CellResult Run(std::size_t method) override;
  Result<Payload> MakeProblem() override;
  Result<Payload> MakeTruth() override;
  Result<CellResult> Judge(const Json& answer) override;

 private:
  const FeatureWeights& WeightsOf(WeightSource source) const;
  CellResult Score(const TransitionOutcome& outcome) const;

  const TransitionBasis basis_;
  const Result<TransitionRequest> request_;
  const bool keeps_motion_;
  std::vector<std::pair<std::string, std::string>> stage_digests_;
};

}  // namespace etude
