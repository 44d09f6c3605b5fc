#pragma once

#include <map>
#include <utility>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/detection/judge.h"
#include "bench/tasks/detection/options.h"
#include "bench/tasks/detection/scoring.h"
#include "bench/tasks/detection/world.h"

namespace etude {

/// A world of the task: one session, and its methods run and judged in it.
class DetectionTaskWorld final : public TaskWorld {
 public:
  /// `methods` and `repertoire` must outlive this.
  DetectionTaskWorld(const std::vector<DetectionMethod>& methods, const Repertoire& repertoire, DetectionWorld world,
                     bool keeps_motion);

  CellResult Run(std::size_t method) override;
  Result<Payload> MakeProblem() override;
  Result<Payload> MakeTruth() override;
  Result<CellResult> Judge(const Json& answer) override;

 private:
  const SeenSession& See(const DetectionMethod& method);
  CellResult Score(const SessionVerdict& verdict) const;

  const std::vector<DetectionMethod>& methods_;
  const Repertoire& repertoire_;
  const DetectionWorld world_;
  const StageDigests world_digests_;
  const bool keeps_motion_;
  std::map<std::pair<FilterKind, bool>, SeenSession> seen_;  ///< by filter and oracle: methods share them
};

}  // namespace etude
