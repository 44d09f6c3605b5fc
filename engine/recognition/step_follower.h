#pragma once

#include <vector>

#include "engine/recognition/pose_vector.h"
#include "engine/recognition/recogniser.h"

namespace etude {

/// A follower that compares motions in steps: what it answers changes with every step, and stays between them.
class StepFollower : public MoveFollower {
 public:
  /// `rate_hz` > 0.
  StepFollower(PoseParts parts, const SightWeights& weights, std::size_t moves, double rate_hz);

  void Ask(std::optional<std::size_t> move) final;
  Evidence Update(const SeenFrame& frame) final;

 protected:
  std::optional<std::size_t> asked() const { return asked_; }

 private:
  /// A window opens, or none is open any more.
  virtual void Open(std::optional<std::size_t> move) = 0;
  /// The next step. Gives the evidence that the performance asked for ends now (0 when none is), and fills in that of
  /// every move in `spotted`.
  virtual double Take(const PoseVector& step, std::span<double> spotted) = 0;

  StepDescriber describer_;
  std::optional<std::size_t> asked_;
  double best_ = 0;  // of the performance asked for
  std::vector<double> spotted_;
};

}  // namespace etude
