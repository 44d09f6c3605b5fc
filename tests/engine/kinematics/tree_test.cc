#include "engine/kinematics/tree.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/kinematics/body_tree.h"
#include "tests/engine/kinematics/posed_tree.h"

namespace etude {
namespace {

// Forward kinematics once more, by 4×4 matrices from the tip of a chain to its root.
glm::dmat4 ChainMatrix(const KinematicTree& tree, const TreeState& state, int joint_index) {
  const TreeJoint& joint = tree.joints[joint_index];
  if (joint.parent < 0) return glm::translate(glm::dmat4(1), state.root_position) * glm::dmat4(state.root_frame);
  glm::dmat4 local = glm::translate(glm::dmat4(1), joint.p_PJ) * glm::dmat4(joint.R_PJ);
  const glm::dvec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int k = 0; k < joint.dof_count; ++k) local = glm::rotate(local, state.angles[joint.first_dof + k], axes[k]);
  return ChainMatrix(tree, state, joint.parent) * local;
}

TEST(Tree, AnAngleIsClampedToTheEndNearestOnTheCircle) {
  const AngleRange raise{Radians(-50), Radians(170)};
  for (const auto& [angle, clamped] :
       {std::pair{20.0, 20.0}, {-60.0, -50.0}, {185.0, 170.0}, {-175.0, 170.0}, {-110.0, -50.0}, {380.0, 20.0}}) {
    EXPECT_NEAR(Degrees(ClampAngle(Radians(angle), raise)), clamped, 1e-9) << angle;
  }
}

TEST(Tree, ForwardKinematicsAgreesWithMatrixProductsAlongEveryChain) {
  const KinematicTree tree = MakeBodyTree({});
  for (int trial = 0; trial < 20; ++trial) {
    const TreeState state = RandomPose(tree, trial, 1.0);
    const TreeFrames frames = ComputeFrames(tree, state);
    for (std::size_t j = 0; j < tree.joints.size(); ++j) {
      const glm::dmat4 expected = ChainMatrix(tree, state, static_cast<int>(j));
      EXPECT_LT(glm::length(frames.joints[j].position - glm::dvec3(expected[3])), 1e-13) << tree.joints[j].name;
      for (int k = 0; k < 3; ++k) {
        EXPECT_LT(glm::length(frames.joints[j].axes[k] - glm::dvec3(expected[k])), 1e-13) << tree.joints[j].name;
      }
    }
    for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
      const glm::dvec4 tip(tree.effectors[e].p_LE, 1);
      const glm::dvec4 expected = ChainMatrix(tree, state, tree.effectors[e].joint) * tip;
      EXPECT_LT(glm::length(frames.effectors[e].position - glm::dvec3(expected)), 1e-13) << tree.effectors[e].name;
    }
  }
}

TEST(Tree, DofAxesGiveTheDerivativeOfEveryEffector) {
  const KinematicTree tree = MakeBodyTree({});
  const TreeState state = RandomPose(tree, 3, 0.9);
  const TreeFrames frames = ComputeFrames(tree, state);
  constexpr double kStep = 1e-6;
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    for (int j = tree.effectors[e].joint; j >= 0; j = tree.joints[j].parent) {
      for (int axis = 0; axis < tree.joints[j].dof_count; ++axis) {
        TreeState ahead = state, behind = state;
        ahead.angles[tree.joints[j].first_dof + axis] += kStep;
        behind.angles[tree.joints[j].first_dof + axis] -= kStep;
        const LimbFrame a = ComputeFrames(tree, ahead).effectors[e], b = ComputeFrames(tree, behind).effectors[e];
        const glm::dvec3 turn = DofAxis(tree.joints[j], frames.R_WJ[j], state.angles, axis);
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
