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

/// One session, and the methods run and judged in it.
class SessionWorld final : public TaskWorld {
 public:
  /// The thresholds of the methods; may be costly the first time.
  using Decide = std::function<const std::vector<MethodDecision>&()>;

  /// Methods and repertoire must outlive this.
  SessionWorld(const std::vector<ReadyMethod>& methods, Decide decide, const Repertoire& repertoire,
               DetectionWorld world, bool keeps_motion);

  /// The thresholds, which worlds share, and the pictures.
  void PrepareShared() override;

  CellResult Run(std::size_t method) override;
  Result<Payload> MakeProblem() override;
  Result<Payload> MakeTruth() override;
  Result<CellResult> Judge(const Json& answer) override;

 private:
  const SeenStream& SeenBy(const DetectionMethod& method);
  CellResult Score(const SessionVerdict& verdict) const;

  struct Sighted {
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
  std::deque<Sighted> seen_;  ///< methods with the same filter, oracle and capture share one
};

/// A trial in which there is nothing to judge.
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
