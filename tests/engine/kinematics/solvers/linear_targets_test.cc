#include "engine/kinematics/solvers/linear_targets.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/kinematics/body_tree.h"
#include "tests/engine/kinematics/posed_tree.h"
#include "tests/engine/kinematics/random_tree.h"

namespace etude {
namespace {

double Square(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return sum;
}

// Returns a problem whose targets all have different weights.
IkProblem Weighted(const KinematicTree& tree, double noise_deg) {
  IkProblem problem = DisturbedProblem(tree, RandomPose(tree, 3, 0.5), 3, noise_deg);
  problem.targets[0].position_weight = 0.25;
  problem.targets[1].axis_weights = {0.5, 2, 3};
  problem.targets[2].axis_weights = {0, 0, 1};
  problem.targets[3].position_weight = 4;
  return problem;
}

TEST(LinearTargets, SquaresOfTheResidualsAreTheSumNearTheTarget) {
  for (const double noise_deg : {1.0, 0.1}) {
    const IkProblem problem = Weighted(Body(), noise_deg);
    const TreeFrames frames = ComputeFrames(Body(), problem.start);
    LinearTargets linear(Body(), problem.targets);
    linear.Build(frames);
    EXPECT_GT(linear.Cost(frames), 0);
    // The first-order residual neglects the third power of the angle.
    EXPECT_NEAR(Square(linear.residuals()) / linear.Cost(frames), 1, 10 * Radians(noise_deg) * Radians(noise_deg));
  }
}

TEST(LinearTargets, TheJacobianFollowsWhatSmallTurnsDoToTheResiduals) {
  const IkProblem problem = Weighted(Body(), 0);  // at the target, where residuals are linear in small turns
  LinearTargets here(Body(), problem.targets), there(Body(), problem.targets);
  here.Build(ComputeFrames(Body(), problem.start));
  ASSERT_LT(Square(here.residuals()), 1e-20);
  constexpr double kStep = 1e-5;
  for (int dof = 0; dof < Body().dof_count(); ++dof) {
    TreeState turned = problem.start;
    turned.angles[dof] += kStep;
    there.Build(ComputeFrames(Body(), turned));
    for (int row = 0; row < here.rows(); ++row) {
      EXPECT_NEAR(-there.residuals()[row] / kStep, here.jacobian()[dof * here.rows() + row], 2e-4) << dof << " " << row;
    }
  }
}

TEST(LinearTargets, HaveNoRowsForWhatHasNoWeight) {
  IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), 3, 0.5), 3, 5);
  const auto rows = [&] {
    LinearTargets linear(Body(), problem.targets);
    linear.Build(ComputeFrames(Body(), problem.start));
    EXPECT_EQ(linear.jacobian().size(), static_cast<std::size_t>(linear.rows() * linear.columns()));
    return linear.rows();
  };
  EXPECT_EQ(rows(), 24);
  problem.targets[0].axis_weights = {0, 0, 1};  // a direction has two degrees of freedom
  EXPECT_EQ(rows(), 23);
  problem.targets[1].position_weight = 0;
  EXPECT_EQ(rows(), 20);
  for (EffectorTarget& target : problem.targets) {
    target.position_weight = 0;
    target.axis_weights = glm::dvec3(0);
  }
  EXPECT_EQ(rows(), 0);
}

TEST(LinearTargets, StepsEndAtTheRangesAndAreShortenedAsAWhole) {
  std::vector<double> step = {0.3, -1.2, 0.6};
  Shorten(step);
  EXPECT_NEAR(step[0], 0.15, 1e-15);
  EXPECT_NEAR(step[1], -0.6, 1e-15);
  EXPECT_NEAR(step[2], 0.3, 1e-15);
  Shorten(step);
  EXPECT_NEAR(step[1], -0.6, 1e-15) << "short enough";
  const std::vector<AngleRange> ranges = {{-1, 0.1}, {-1, 1}, {0, 0}};
  std::vector<double> angles = {0, 0.5, 0};
  EXPECT_NEAR(MoveWithin(ranges, angles, step, angles), 0.6, 1e-15);
  EXPECT_NEAR(angles[0], 0.1, 1e-15);
  EXPECT_NEAR(angles[1], -0.1, 1e-15);
  EXPECT_EQ(angles[2], 0);
}

// Forward kinematics by products of exponentials (Brockett 1984; Lynch and Park 2017, chapter 4). Each angle rotates
// about its axis in the world at zero angles (a screw). A point is moved by the screws of all angles from its limb to
// the root, one after the other. No frame of a posed limb is used.
class Screws {
 public:
  Screws(const KinematicTree& tree, const TreeState& state) : tree_(tree), angles_(state.angles) {
    for (const TreeJoint& joint : tree.joints) {
      const glm::dmat4 local = glm::translate(glm::dmat4(1), joint.p_PJ) * glm::dmat4(joint.R_PJ);
      at_zero_.push_back(joint.parent >= 0
                             ? at_zero_[joint.parent] * local
                             : glm::translate(glm::dmat4(1), state.root_position) * glm::dmat4(state.root_frame));
    }
  }

  glm::dmat4 LimbFrame(int joint) const { return Movement(joint, tree_.joints[joint].dof_count) * at_zero_[joint]; }

  // Returns the velocity and rotation vector that one radian of an angle gives to a point below it.
  std::array<glm::dvec3, 2> Twist(int joint, int axis, const glm::dvec3& point) const {
    const glm::dmat4 before = Movement(joint, axis);
    const glm::dvec3 turn(before * at_zero_[joint][axis]);
    const glm::dvec3 place(before * at_zero_[joint][3]);
    return {glm::cross(turn, point) + glm::cross(place, turn), turn};
  }

 private:
  // Returns the product of all exponentials from the root to the first `axes` angles of `joint`.
  glm::dmat4 Movement(int joint, int axes) const {
    const TreeJoint& row = tree_.joints[joint];
    glm::dmat4 product = row.parent < 0 ? glm::dmat4(1) : Movement(row.parent, tree_.joints[row.parent].dof_count);
    const glm::dmat4& zero = at_zero_[joint];
    for (int k = 0; k < axes; ++k) {
      product = glm::translate(product, glm::dvec3(zero[3]));
      product = glm::rotate(product, angles_[row.first_dof + k], glm::dvec3(zero[k]));
      product = glm::translate(product, -glm::dvec3(zero[3]));
    }
    return product;
  }

  const KinematicTree& tree_;
  const std::vector<double>& angles_;
  std::vector<glm::dmat4> at_zero_;
};

struct Posed {
  KinematicTree tree;
  TreeState state;
};

// Returns the body, and random trees that no solver was written for.
std::vector<Posed> Samples() {
  std::vector<Posed> samples;
  for (int trial = 0; trial < 20; ++trial) {
    for (const KinematicTree& tree : {MakeBodyTree({}), RandomTree(trial, 9)}) {
      samples.push_back({tree, RandomPose(tree, trial, 1.0)});
    }
  }
  return samples;
}

double Gap(const LimbFrame& frame, const glm::dmat4& other) {
  double gap = glm::distance(frame.position, glm::dvec3(other[3]));
  for (int k = 0; k < 3; ++k) gap = std::max(gap, glm::distance(frame.axes[k], glm::dvec3(other[k])));
  return gap;
}

TEST(Jacobian, FramesAgreeWithProductsOfExponentials) {
  for (const auto& [tree, state] : Samples()) {
    const TreeFrames frames = ComputeFrames(tree, state);
    const Screws screws(tree, state);
    for (std::size_t j = 0; j < tree.joints.size(); ++j) {
      EXPECT_LT(Gap(frames.joints[j], screws.LimbFrame(static_cast<int>(j))), 1e-12);
    }
    for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
      const glm::dmat4 tip = glm::translate(screws.LimbFrame(tree.effectors[e].joint), tree.effectors[e].p_LE);
      EXPECT_LT(Gap(frames.effectors[e], tip), 1e-12);
    }
  }
}

TEST(Jacobian, AgreesWithProductsOfExponentials) {
  int zeros = 0, others = 0;
  for (const auto& [tree, state] : Samples()) {
    const TreeFrames frames = ComputeFrames(tree, state);
    TreeJacobian jacobian;
    ComputeJacobian(tree, frames, jacobian);
    ASSERT_EQ(jacobian.rows, 24);
    const Screws screws(tree, state);
    for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
      std::vector<std::array<glm::dvec3, 2>> expected(state.angles.size());
      for (int j = tree.effectors[e].joint; j >= 0; j = tree.joints[j].parent) {
        for (int k = 0; k < tree.joints[j].dof_count; ++k) {
          expected[tree.joints[j].first_dof + k] = screws.Twist(j, k, frames.effectors[e].position);
        }
      }
      for (int dof = 0; dof < tree.dof_count(); ++dof) {
        const double* cell = jacobian.column(dof).data() + 6 * e;
        for (int row = 0; row < 6; ++row) {
          EXPECT_NEAR(cell[row], expected[dof][row / 3][row % 3], 1e-12);
          ++(cell[row] == 0 ? zeros : others);
        }
      }
    }
  }
  EXPECT_GT(zeros, 1000) << "angles that lead to no effector";
  EXPECT_GT(others, 1000);
}

TEST(Jacobian, KeepsNothingOfAnotherPose) {
  TreeJacobian used, fresh;
  ComputeJacobian(RandomTree(1, 12), ComputeFrames(RandomTree(1, 12), StandingState(RandomTree(1, 12))), used);
  const TreeFrames frames = ComputeFrames(Body(), RandomPose(Body(), 2, 0.7));
  ComputeJacobian(Body(), frames, used);
  ComputeJacobian(Body(), frames, fresh);
  EXPECT_EQ(used.rows, fresh.rows);
  EXPECT_EQ(used.values, fresh.values);
}

}  // namespace
}  // namespace etude
