#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/transition/options.h"
#include "bench/tasks/transition/request.h"
#include "bench/tasks/transition/scoring.h"
#include "bench/tasks/transition/stage.h"
#include "bench/training/learnt_weights.h"

namespace etude {

/// What the worlds of a task share; all of it must outlive them.
struct TransitionBasis {
  const std::vector<TransitionMethod>& methods;
  const Stage& stage;
  LearntWeights& learnt;  ///< remembers fits; what it answers depends on the question only
  double max_wait_s = 0;  ///< told to methods outside; built-in ones have their own
  bool explain = false;   ///< whether every cell keeps its explanation
};

/// A world of the task: one request, on the task's stage.
class TransitionWorld final : public TaskWorld {
 public:
  /// A request that failed is a world to be skipped.
  TransitionWorld(const TransitionBasis& basis, Result<SwitchRequest> request, bool keeps_motion);

  std::optional<std::string> WhySkipped() const override;
  void PrepareShared() override;
  CellResult Run(std::size_t method) override;
  Result<Payload> MakeProblem() override;
  Result<Payload> MakeTruth() override;
  Result<CellResult> Judge(const Json& answer) override;

 private:
  const FeatureWeights& WeightsOf(WeightSource source) const;
  CellResult Score(const SwitchOutcome& outcome) const;

  const TransitionBasis basis_;
  const Result<SwitchRequest> request_;
  const bool keeps_motion_;
  std::vector<std::pair<std::string, std::string>> stage_digests_;
};

}  // namespace etude
