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
#include "bench/training/learnt_weights.h"
#include "engine/transitions/choices/choice.h"

namespace etude {

/// Counts the pairs of frames that a fuzzy choice may take, and the pairs among them that match by the rules of `way`.
MatchTally TallyMatches(const Stage& stage, const TransitionRequest& request, const TransitionWay& way);

/// Measures the metrics of a transition (docs/reference/metrics.md) from the segments that it plays. A transition
/// through clips in between has several transition points. A metric of a transition point is then that of the worst
/// point.
void ScoreTransition(const TransitionOutcome& outcome, const Stage& stage, CellResult& result);

/// Measures the metrics of the pairs of frames that a transition could have used. The metrics are missing for a method
/// without a threshold.
void ScoreMatching(const std::optional<MatchTally>& tally, CellResult& result);

/// Returns the ids of all metrics of the task, in the order in which they are measured.
std::vector<std::string> TransitionMetrics();

/// Returns the value of a metric for a method that made no transition (Task::ValueOfFailure). It is 0 for
/// `natural_share` and the other shares over all cells: if missing transitions were not counted, a method could raise
/// its share by failing in hard cases. Returns nullopt for other metrics. For example, a jump that was not made has
/// no size, and if `false_smooth` were 0, the failure would be rewarded.
std::optional<double> TransitionFailureValue(std::string_view metric);

/// Records the metrics of ScoreTransition for a world in which no transition was found: the values of
/// TransitionFailureValue, and all other metrics as missing.
void MeasureNoWay(CellResult& result);

/// The data that the runs of a task share. All data must outlive the runs.
struct TransitionBasis {
  const std::vector<TransitionMethod>& methods;
  const Stage& stage;
  LearntWeights& learnt;  ///< fits weights and caches them; no result depends on the state of the cache
  double max_wait_s = 0;  ///< the wait that is sent to outside methods; built-in methods have waits of their own
  bool explain = false;   ///< true: every cell keeps the explanation of its transition
};

/// The world of one request on the task's stage, in which methods are run and scored.
class TransitionRun final : public TaskWorld {
 public:
  /// If the request is an error, the world is skipped.
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
