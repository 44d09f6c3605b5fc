#include "engine/kinematics/solvers/fabrik.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/euler.h"
#include "engine/kinematics/body_tree.h"
#include "tests/engine/kinematics/posed_tree.h"
#include "tests/engine/kinematics/solvers/arms.h"

namespace etude {
namespace {

double Worst(const IkSolution& solution, const IkProblem& problem) {
  return FindWorst(solution.errors, problem.targets).position;
}

// Returns the body's problem without axes, which FABRIK ignores.
IkProblem PositionProblem(const KinematicTree& tree, int trial, double share, double noise_deg) {
  IkProblem problem = DisturbedProblem(tree, RandomPose(tree, trial, share), trial, noise_deg);
  for (EffectorTarget& target : problem.targets) target.axis_weights = glm::dvec3(0);
  return problem;
}

TEST(FabrikPass, DoesToAChainWhatThePaperWrites) {
  const std::vector<double> lengths = {0.5, 0.4, 0.3, 0.2};
  const KinematicTree arm = Arm(lengths, 3);
  IkProblem problem = Reach(arm, {0.3, 0.2, 0, -0.4, 0.1, 0.2, 0.5, -0.3, 0, 0.2, 0.2, 0}, {0.6, -0.3, 1.4});
  TreeFrames frames = ComputeFrames(arm, problem.start);
  // Aristidou and Lasenby 2011, algorithm 1, on points alone.
  std::vector<glm::dvec3> p;
  for (std::size_t j = 1; j < arm.joints.size(); ++j) p.push_back(frames.joints[j].position);
  p.push_back(frames.effectors[0].position);
  const glm::dvec3 root = p[0];
  FabrikPass pass(arm, problem.targets);
  for (int round = 0; round < 5; ++round) {
    p[4] = problem.targets[0].position;
    for (int i = 3; i >= 0; --i) p[i] = p[i + 1] + lengths[i] * glm::normalize(p[i] - p[i + 1]);
    p[0] = root;
    for (int i = 0; i < 4; ++i) p[i + 1] = p[i] + lengths[i] * glm::normalize(p[i + 1] - p[i]);

    pass.Run(frames);
    for (int i = 0; i < 4; ++i) {
      EXPECT_LT(glm::distance(pass.limbs()[i + 1].position, p[i]), 1e-12) << round << " point " << i;
    }
    frames.joints.assign(pass.limbs().begin(), pass.limbs().end());
    EXPECT_LT(glm::distance(p[4], frames.joints[4].position + frames.joints[4].axes * arm.effectors[0].p_LE), 1e-12);
  }
}

TEST(FabrikPass, KeepsAllDistancesWithinTheBodysRigidParts) {
  const IkProblem problem = PositionProblem(Body(), 2, 0.8, 20);
  const TreeFrames frames = ComputeFrames(Body(), problem.start);
  FabrikPass pass(Body(), problem.targets);
  pass.Run(frames);
  const auto distance = [&](int a, int b) { return glm::distance(pass.limbs()[a].position, pass.limbs()[b].position); };
  const LimbLengths lengths;
  EXPECT_NEAR(distance(kTreeLeftAnkle, kTreeLeftKnee), lengths.shank, 1e-12);
  EXPECT_NEAR(distance(kTreeLeftHip, kTreeRightHip), lengths.hip_width, 1e-12);
  EXPECT_NEAR(distance(kTreeLeftHip, kTreeNavel), lengths.hip_width / 2, 1e-12);
  EXPECT_NEAR(distance(kTreeNavel, kTreeNeck), lengths.trunk, 1e-12);
  EXPECT_NEAR(distance(kTreeLeftShoulder, kTreeRightShoulder), lengths.shoulder_width, 1e-12);
  EXPECT_NEAR(distance(kTreeNavel, kTreeLeftShoulder), std::hypot(lengths.trunk, lengths.shoulder_width / 2), 1e-12);
  EXPECT_NEAR(distance(kTreeRightElbow, kTreeRightWrist), lengths.forearm, 1e-12);
  EXPECT_GT(glm::distance(pass.limbs()[kTreeNeck].position, frames.joints[kTreeNeck].position), 1e-3) << "it did move";
}

TEST(FabrikPass, LeavesABodyAtItsTargetsAlone) {
  const IkProblem problem = PositionProblem(Body(), 2, 0.8, 0);
  const TreeFrames frames = ComputeFrames(Body(), problem.start);
  FabrikPass pass(Body(), problem.targets);
  pass.Run(frames);
  for (std::size_t j = 0; j < Body().joints.size(); ++j) {
    EXPECT_LT(glm::distance(pass.limbs()[j].position, frames.joints[j].position), 1e-12) << Body().joints[j].name;
  }
}

TEST(BestTurn, FindsTheRotationOfARigidTriangle) {
  const glm::dmat3 turn = RotationXyz({0.4, -1.1, 2.5});
  const std::vector<glm::dvec3> from = {{1, 0, 0}, {0, 2, 0}, {1, 1, 0}};
  std::vector<glm::dvec3> to;
  for (const glm::dvec3& v : from) to.push_back(turn * v);
  const glm::dmat3 found = BestTurn(from, to);
  for (int k = 0; k < 3; ++k) EXPECT_LT(glm::distance(found[k], turn[k]), 1e-12);
}

TEST(BestTurn, IsNoMirrorImage) {
  const std::vector<glm::dvec3> from = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, mirrored = {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_NEAR(glm::determinant(BestTurn(from, mirrored)), 1, 1e-12);
}

TEST(BestTurn, TurnsALineWithoutTwist) {
  const std::vector<glm::dvec3> from = {{0, 0, 1}, {0, 0, -2}};
  const glm::dmat3 found = BestTurn(from, std::vector<glm::dvec3>{{0.5, 0, 0}, {-2.5, 0, 0}});
  EXPECT_LT(glm::distance(found[2], {1, 0, 0}), 1e-12);
  EXPECT_LT(glm::distance(found[1], {0, 1, 0}), 1e-12) << "about the one axis normal to both lines";
  const glm::dmat3 none = BestTurn(from, std::vector<glm::dvec3>(2, glm::dvec3(0)));
  EXPECT_EQ(none, glm::dmat3(1)) << "nothing tells";
}

TEST(Fabrik, ReachesWithinTheArmsLength) {
  const KinematicTree arm = Arm({0.5, 0.4, 0.3}, 3);
  for (const glm::dvec3 place : {glm::dvec3{0.6, 0.3, 1.2}, {-0.2, -0.5, 1.5}, {0, 0.9, 0.7}}) {
    const IkProblem problem = Reach(arm, std::vector<double>(9, 0.1), place);
    const IkSolution solution = SolveFabrik(arm, problem, Exactly());
    EXPECT_EQ(solution.status, IkStatus::kConverged);
    EXPECT_LT(Worst(solution, problem), 1e-10);
  }
}

TEST(Fabrik, StretchesTowardsWhatIsTooFarAway) {
  const KinematicTree arm = Arm({0.5, 0.4, 0.3}, 3);
  const IkProblem problem = Reach(arm, std::vector<double>(9, 0.1), {2, 0, 1});
  const IkSolution solution = SolveFabrik(arm, problem, {.max_iterations = 5000});
  EXPECT_EQ(solution.status, IkStatus::kUnreachable);
  EXPECT_NEAR(Worst(solution, problem), 2 - 1.2, 1e-6);
}

TEST(Fabrik, AStretchedLimbStaysAsItIs) {
  const KinematicTree arm = Arm({0.5, 0.4}, 3);
  const IkSolution solution = SolveFabrik(arm, Reach(arm, std::vector<double>(6, 0.0), {0, 0, 1.5}), {});
  EXPECT_EQ(solution.status, IkStatus::kStalled);
  EXPECT_EQ(solution.angles, std::vector<double>(6, 0.0));
}

TEST(Fabrik, MovesNothingThatLeadsToNoTarget) {
  IkProblem problem = PositionProblem(Body(), 1, 0.5, 10);
  problem.targets[1].position_weight = 0;
  const IkSolution solution = SolveFabrik(Body(), problem, {});
  EXPECT_EQ(solution.status, IkStatus::kConverged);
  for (const BodyTreeJoint joint : {kTreeLeftShoulder, kTreeLeftElbow, kTreeLeftWrist}) {
    const int first = Body().joints[joint].first_dof;
    for (int dof = first; dof < first + Body().joints[joint].dof_count; ++dof) {
      EXPECT_EQ(solution.angles[dof], problem.start.angles[dof]);
    }
  }
}

TEST(Fabrik, BringsFarPosesHomeWithinTheLimits) {
  IkOptions options{.max_iterations = 250};
  int solved = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const IkProblem problem = PositionProblem(Body(), trial, 0.5, 15);
    const IkSolution solution = SolveFabrik(Body(), problem, options);
    solved += solution.status == IkStatus::kConverged;
    EXPECT_EQ(solution.status == IkStatus::kConverged, Worst(solution, problem) < options.position_goal);
  }
  EXPECT_GE(solved, 18);
}

}  // namespace
}  // namespace etude
