#include "engine/kinematics/tree.h"

#include <gtest/gtest.h>


#include "engine/kinematics/body_tree.h"
#include "tests/engine/kinematics/posed_tree.h"

namespace etude {
namespace {

TEST(Tree, AnAngleIsClampedToTheEndNearestOnTheCircle) {
  const AngleRange raise{Radians(-50), Radians(170)};
  for (const auto& [angle, clamped] :
       {std::pair{20.0, 20.0}, {-60.0, -50.0}, {185.0, 170.0}, {-175.0, 170.0}, {-110.0, -50.0}, {380.0, 20.0}}) {
    EXPECT_NEAR(Degrees(ClampAngle(Radians(angle), raise)), clamped, 1e-9) << angle;
  }
}

TEST(Tree, DofAxesGiveTheDerivativeOfEveryEffector) {
  const TreeState state = RandomPose(Body(), 3, 0.9);
  const TreeFrames frames = ComputeFrames(Body(), state);
  constexpr double kStep = 1e-6;
  for (std::size_t e = 0; e < Body().effectors.size(); ++e) {
    for (int j = Body().effectors[e].joint; j >= 0; j = Body().joints[j].parent) {
      for (int axis = 0; axis < Body().joints[j].dof_count; ++axis) {
        TreeState ahead = state, behind = state;
        ahead.angles[Body().joints[j].first_dof + axis] += kStep;
        behind.angles[Body().joints[j].first_dof + axis] -= kStep;
        const LimbFrame a = ComputeFrames(Body(), ahead).effectors[e], b = ComputeFrames(Body(), behind).effectors[e];
        const glm::dvec3 turn = DofAxis(Body().joints[j], frames.R_WJ[j], state.angles, axis);
        const glm::dvec3 arm = frames.effectors[e].position - frames.joints[j].position;
        EXPECT_LT(glm::length((a.position - b.position) / (2 * kStep) - glm::cross(turn, arm)), 1e-9);
        EXPECT_LT(glm::length((a.axes[1] - b.axes[1]) / (2 * kStep) - glm::cross(turn, frames.effectors[e].axes[1])),
                  1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace etude
