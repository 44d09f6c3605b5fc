#pragma once

#include <optional>
#include <vector>

#include "bench/tasks/coach/session.h"
#include "bench/tasks/coach/world.h"
#include "sim/performer/learner.h"

namespace etude {

/// The simulated learner before the coach.
///
/// Learners see the dance go on and dance to where it will be when they move, so that they are late by their lag alone.
/// They react to unexpected events (the coach stops, shakes its head, shows the move) later, by the number of frames
/// that poses are requested ahead.
class LearnerPlayer final : public Player {
 public:
  /// Both must outlive this.
  LearnerPlayer(const CoachWorld& world, const CoachStage& stage);

  BodyPose Next(const CoachOutput& shown) override;
  std::optional<PlayedPerformance> PerformanceOf(int repetition) const override;
  bool HasGivenUp() const override { return learner_.HasGivenUp(); }
  std::vector<double> TakeTest(int performances_later) override;

 private:
  Shown SeenOf(const CoachOutput& shown);
  void SeeDance(const CoachOutput& shown, Shown& seen);
  void SeeRecords(const CoachOutput& shown, Shown& seen);
  int MoveShownSlowly(std::string_view clip) const;

  const CoachStage& stage_;
  Learner learner_;
  std::optional<double> last_frame_;  ///< the dance's frame shown before; empty if it was not danced
  int danced_ = -1;                   ///< the repetition danced in the frame before; −1: none
  int performances_ = 0;              ///< number begun so far; a repeated repetition is a new performance
  int about_ = -1;                    ///< the move of the latest correction
  std::vector<int> latest_;           ///< by repetition of the dance, its latest performance; −1: none
};

}  // namespace etude
