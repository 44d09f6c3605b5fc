#pragma once

#include <optional>
#include <vector>

#include "bench/tasks/coach/session.h"
#include "bench/tasks/coach/world.h"
#include "sim/performer/learner.h"

namespace etude {

/// The simulated learner before the coach.
///
/// They see the dance go on and dance to where it will be when they move, so that they are as late as their lag says;
/// what they did not expect (the coach stops, shakes its head, shows the move) they act on later by as much as poses
/// are asked for ahead.
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
  std::optional<double> last_frame_;  ///< of the dance, where it was danced in the frame before
  int danced_ = -1;                   ///< the repetition danced in the frame before; −1: none
  int performances_ = 0;              ///< begun so far: a repetition that is danced again is another one
  int about_ = -1;                    ///< the move of the latest correction
  std::vector<int> latest_;           ///< by repetition of the dance, its latest performance; −1: none
};

}  // namespace etude
