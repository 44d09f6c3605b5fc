#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/transition/options.h"
#include "bench/tasks/transition/score.h"
#include "bench/tasks/transition/stage.h"
#include "bench/tasks/transition/world.h"
#include "bench/training/learnt_weights.h"

namespace etude {

/// What the runs of a task share; all of it must outlive them.
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
