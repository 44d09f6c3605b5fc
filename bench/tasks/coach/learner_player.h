#pragma once

#include <optional>
#include <vector>

#include "bench/tasks/coach/session.h"
#include "bench/tasks/coach/world.h"
#include "sim/performer/learner.h"

namespace etude {

/// The simulated learner in front of the coach.
///
/// Learners predict the state of the dance at the time of their movement, so they are late only by their own lag.
/// Unexpected events (the coach stops, shakes its head, shows the move) cannot be predicted. Learners react to these
/// events at least SkeletonSensor::kAhead + 1 frames after the screen showed them, because poses are requested in
/// advance.
class LearnerPlayer final : public Player {
 public:
  /// `world` and `stage` must outlive this object.
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
  /// The number of the dance's frame that was shown in the previous frame of the session; empty if the dance was not
  /// shown.
  std::optional<double> last_frame_;
  int danced_ = -1;          ///< the repetition that the learner danced in the previous frame; −1: none
  int performances_ = 0;     ///< number of performances begun; a repetition that is danced twice counts as two
  int about_ = -1;           ///< index of the move of the latest correction; −1: none
  std::vector<int> latest_;  ///< for each repetition of the dance, the index of its latest performance; −1: none
};

}  // namespace etude
