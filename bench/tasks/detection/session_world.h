#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/detection/operating_point.h"
#include "bench/tasks/detection/score.h"

namespace etude {

/// One session, in which methods are run and scored.
class SessionWorld final : public TaskWorld {
 public:
  /// A function that returns the thresholds of the methods. The first call may be expensive.
  using Decide = std::function<const std::vector<MethodDecision>&()>;

  /// A function that returns the `setting` message of this world, for tasks whose worlds have different ones.
  using Set = std::function<Payload()>;

  /// `methods` and `repertoire` must outlive this object. `set` is empty if the task's worlds share a setting.
  SessionWorld(const std::vector<ReadyMethod>& methods, Decide decide, const Repertoire& repertoire,
               DetectionWorld world, bool keeps_motion, Set set = {});

  /// Computes the methods' thresholds, unless an earlier world has. If the condition has cameras, also renders their
  /// pictures.
  void PrepareShared() override;

  CellResult Run(std::size_t method) override;
  Result<Payload> MakeSetting() override;
  Result<Payload> MakeProblem() override;
  Result<Payload> MakeTruth() override;
  Result<CellResult> Judge(const Json& answer) override;

 private:
  const SeenStream& SeenBy(const DetectionMethod& method);
  CellResult Score(const SessionVerdict& verdict) const;

  struct SeenByMethods {
    FilterOptions filter;
    bool sees_truth;
    std::optional<CaptureMethod> capture;
    SeenStream seen;
  };

  const std::vector<ReadyMethod>& methods_;
  const Decide decide_;
  const Repertoire& repertoire_;
  const DetectionWorld world_;
  const StageDigests world_digests_ = WorldDigests(world_);
  const bool keeps_motion_;
  const Set set_;
  std::deque<SeenByMethods> seen_;  ///< one entry for all methods with the same filter, oracle and capture
};

/// A trial that cannot be judged.
class SkippedWorld final : public TaskWorld {
 public:
  explicit SkippedWorld(std::string reason) : reason_(std::move(reason)) {}

  std::optional<std::string> WhySkipped() const override { return reason_; }
  CellResult Run(std::size_t) override { return CellResult::Ended(Status::kSkipped, reason_); }
  Result<Payload> MakeProblem() override { return Fail({}, "{}", reason_); }
  Result<Payload> MakeTruth() override { return Fail({}, "{}", reason_); }
  Result<CellResult> Judge(const Json&) override { return Fail({}, "{}", reason_); }

 private:
  std::string reason_;
};

}  // namespace etude
