#include "engine/kinematics/solvers/ccd.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/euler.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/moment_sweep.h"
#include "sim/random/stream.h"
#include "tests/engine/kinematics/posed_tree.h"
#include "tests/engine/kinematics/solvers/arms.h"

namespace etude {
namespace {

// Returns the quantity that a sweep with fixed weights reduces: Σ w_p |P_d − P_c|² + Σ w_o |u_d − u_c|².
double Penalty(const KinematicTree& tree, const IkProblem& problem, std::span<const double> angles, WeightRule rule) {
  const EffectorWeights weights = ComputeWeights(rule, 0, glm::dvec3(0));
  const TreeFrames frames =
      ComputeFrames(tree, {problem.start.root_position, problem.start.root_frame, {angles.begin(), angles.end()}});
  double penalty = 0;
  for (std::size_t e = 0; e < problem.targets.size(); ++e) {
    const glm::dvec3 gap = problem.targets[e].position - frames.effectors[e].position;
    penalty += weights.position * glm::dot(gap, gap);
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 off = problem.targets[e].axes[k] - frames.effectors[e].axes[k];
      penalty += weights.axes[k] * glm::dot(off, off);
    }
  }
  return penalty;
}

// Returns the penalty's largest relative rise from one sweep to the next.
double LargestRise(CcdJoint joint_kind, bool limits) {
  double largest = -1;
  for (int trial = 0; trial < 10; ++trial) {
    const IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), trial, 1.0), trial, 30);
    for (WeightRule rule : {WeightRule::kFixed, WeightRule::kFixedTuned}) {
      IkOptions options{.weights = rule, .limits = limits};
      CcdSweep ccd(Body(), problem, options, joint_kind);
      double before = Penalty(Body(), problem, ccd.angles(), rule);
      for (int sweep = 0; sweep < 40; ++sweep) {
        ccd.Sweep();
        const double after = Penalty(Body(), problem, ccd.angles(), rule);
        largest = std::max(largest, (after - before) / before);
        before = after;
      }
    }
  }
  return largest;
}

TEST(Ccd, HingesNeverRaiseThePenaltyOfFixedWeights) {
  EXPECT_LE(LargestRise(CcdJoint::kHinges, true), 1e-12);
  EXPECT_LE(LargestRise(CcdJoint::kHinges, false), 1e-12);
}

TEST(Ccd, ClippingAWholeJointsAnglesCanRaiseThePenalty) {
  EXPECT_GT(LargestRise(CcdJoint::kWhole, true), 1e-6)
      << "B's joint treatment is not monotone, which is why hinges are";
}

TEST(Ccd, AHingeInReachOfItsTargetNeedsOneSweep) {
  const KinematicTree arm = Arm({0.5}, 1);
  const IkProblem problem = Reach(arm, {0}, {0, -0.5 * std::sin(2.0), 1 + 0.5 * std::cos(2.0)});
  for (const auto& solve : {SolveCcd, SolveCcdHinges}) {
    const IkSolution solution = solve(arm, problem, IkOptions{});
    EXPECT_EQ(solution.status, IkStatus::kConverged);
    EXPECT_EQ(solution.iterations, 1);
    EXPECT_NEAR(solution.angles[0], 2.0, 1e-12);
  }
}

// Position and axes pull a hinge of lever 0.5 m to the angles α and β. Two of the axes turn, so the optimum maximises
// w_p r d cos(φ − α) + 2 w_o cos(φ − β).
TEST(Ccd, EveryWeightPullsAHingeAsItsFormulaSays) {
  KinematicTree arm = Arm({0.5}, 1);
  constexpr double kLever = 0.5, kDistance = 0.8, kAlpha = 0.9, kBeta = -0.6;
  IkProblem problem = Reach(arm, {0}, {0, -kDistance * std::sin(kAlpha), 1 + kDistance * std::cos(kAlpha)});
  problem.targets[0].axes = RotationXyz({kBeta, 0, 0}) * arm.standing_root;
  const double apart_cm =
      100 * std::sqrt(kLever * kLever + kDistance * kDistance - 2 * kLever * kDistance * std::cos(kAlpha));
  struct Row {
    WeightRule rule;
    // The weight of the squared distance in cm², and the weight of axes 1 and 2. Axis 0 is parallel to the hinge, so
    // its weight has no effect.
    double position, axis;
  };
  for (const Row& row : {Row{WeightRule::kFixed, 1, 1}, Row{WeightRule::kFixedTuned, 0.0015, 1},
                         Row{WeightRule::kAdaptive, apart_cm, Degrees(-kBeta)},
                         Row{WeightRule::kAdaptiveTuned, 0.003 * apart_cm, Degrees(-kBeta)},
                         Row{WeightRule::kAdaptivePower, 5e-5 * std::pow(apart_cm, 0.75), std::pow(-kBeta, 0.75)},
                         Row{WeightRule::kWangChen, 0.0007 * (1 + kLever / kDistance), 1}}) {
    for (const double share : {1.0, 0.3}) {
      problem.targets[0].position_weight = share;
      problem.targets[0].axis_weights = glm::dvec3(2 - share);
      const double pull = share * row.position * (100 * kLever) * (100 * kDistance), turn = 2 * (2 - share) * row.axis;
      const double expected = std::atan2(pull * std::sin(kAlpha) + turn * std::sin(kBeta),
                                         pull * std::cos(kAlpha) + turn * std::cos(kBeta));
      IkOptions options{.weights = row.rule, .max_iterations = 1};
      for (const auto& solve : {SolveCcd, SolveCcdHinges}) {
        EXPECT_NEAR(solve(arm, problem, options).angles[0], expected, 1e-9)
            << WeightRuleNames()[static_cast<int>(row.rule)] << " " << share;
      }
    }
  }
}

TEST(Ccd, TheMeritOfASweepIsThePenaltyByItsWeights) {
  const IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), 2, 0.8), 2, 30);
  IkOptions options{.weights = WeightRule::kFixedTuned};
  CcdSweep ccd(Body(), problem, options, CcdJoint::kHinges);
  MomentSweep moments(Body(), problem, options);
  for (int sweep = 0; sweep < 3; ++sweep) {
    ccd.Sweep();
    moments.Sweep();
    const double penalty = Penalty(Body(), problem, ccd.angles(), options.weights);
    EXPECT_NEAR(ccd.Merit(), penalty, 1e-9 * penalty);
    EXPECT_NEAR(moments.Merit(), penalty, 1e-9 * penalty);
  }
}

TEST(Ccd, AWholeJointPushedBeyondHalfATurnStaysAtItsNearerLimit) {
  KinematicTree arm;
  arm.joints = {{.name = "root"}, {.name = "ball", .parent = 0, .p_PJ = {0, 0, 1}, .dof_count = 3}};
  arm.effectors = {{"tip", 1, {0, 0, 0.5}}};
  arm.limits = {{Radians(-50), Radians(170)}, {Radians(-80), Radians(80)}, {Radians(-70), Radians(70)}};
  TreeState truth = StandingState(arm);
  truth.angles[0] = Radians(200);
  const IkProblem problem = DisturbedProblem(arm, truth, 0, 0);
  ASSERT_NEAR(Degrees(problem.start.angles[0]), 170, 1e-9);
  EXPECT_NEAR(Degrees(SolveCcd(arm, problem, IkOptions{}).angles[0]), 170, 1e-9)
      << "200 degrees, which Euler angles call -160, are not next to -50";
}

TEST(Ccd, RefreshingFixedWeightsChangesNoBit) {
  const IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), 4, 0.5), 4, 15);
  for (const auto& solve : {SolveCcd, SolveCcdHinges}) {
    IkOptions options{.max_iterations = 20};
    options.weights = WeightRule::kFixedTuned;
    const IkSolution per_sweep = solve(Body(), problem, options);
    options.refresh = WeightRefresh::kDof;
    EXPECT_EQ(solve(Body(), problem, options).angles, per_sweep.angles);

    options.weights = WeightRule::kAdaptive;
    const IkSolution adaptive_per_dof = solve(Body(), problem, options);
    options.refresh = WeightRefresh::kJoint;
    const IkSolution adaptive_per_joint = solve(Body(), problem, options);
    options.refresh = WeightRefresh::kSweep;
    const IkSolution adaptive_per_sweep = solve(Body(), problem, options);
    EXPECT_NE(adaptive_per_dof.angles, adaptive_per_joint.angles) << "adaptive weights must feel the difference";
    EXPECT_NE(adaptive_per_joint.angles, adaptive_per_sweep.angles);
  }
}

// If every joint is a hinge, refreshing per degree of freedom equals refreshing per joint.
TEST(Ccd, RefreshingPerHingeIsRefreshingPerJointOnAChainOfHinges) {
  const KinematicTree arm = Arm({0.5, 0.4, 0.3}, 1);
  const IkProblem problem = Reach(arm, {0.3, 0.2, -0.4}, {0, 0.5, 1.2});
  for (const auto& solve : {SolveCcd, SolveCcdHinges}) {
    const auto angles = [&](WeightRefresh refresh) {
      IkProblem turned = problem;  // axes are needed: with positions alone, weights only scale the gain
      turned.targets[0].axis_weights = glm::dvec3(1);
      turned.targets[0].axes = RotationXyz({0.8, 0, 0}) * arm.standing_root;
      IkOptions options{.weights = WeightRule::kAdaptive, .max_iterations = 4};
      options.refresh = refresh;
      return solve(arm, turned, options).angles;
    };
    EXPECT_EQ(angles(WeightRefresh::kDof), angles(WeightRefresh::kJoint));
    EXPECT_NE(angles(WeightRefresh::kSweep), angles(WeightRefresh::kJoint)) << "else nothing is refreshed";
  }
}

TEST(Ccd, TheOrderInWhichEffectorsAreListedDoesNotMatter) {
  KinematicTree tree = MakeBodyTree({});
  IkProblem problem = DisturbedProblem(tree, RandomPose(tree, 5, 0.5), 5, 15);
  IkOptions options{.max_iterations = 5};
  const IkSolution listed = SolveCcd(tree, problem, options);
  std::swap(tree.effectors[0], tree.effectors[3]);
  std::swap(problem.targets[0], problem.targets[3]);
  const IkSolution swapped = SolveCcd(tree, problem, options);
  for (std::size_t i = 0; i < listed.angles.size(); ++i) EXPECT_NEAR(listed.angles[i], swapped.angles[i], 1e-9);
}

// Tables 3.3 and 5.1: with untuned fixed weights, positions reach their targets but axes do not; with updated
// weights, both do.
TEST(Ccd, UpdatedWeightsBringTheAxesHomeThatFixedOnesLeaveOff) {
  for (int trial = 0; trial < 4; ++trial) {
    const IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), trial, 0.5), trial, 15);
    const auto worst = [&](WeightRule rule) {
      return FindWorst(SolveCcd(Body(), problem, {.weights = rule, .max_iterations = 300}).errors, problem.targets);
    };
    const WorstError fixed = worst(WeightRule::kFixed), adaptive = worst(WeightRule::kAdaptive);
    EXPECT_LT(fixed.position, 0.01) << trial;
    EXPECT_GT(fixed.axis, Radians(5)) << trial;
    EXPECT_LT(adaptive.axis, 0.5 * fixed.axis) << trial;
  }
}

struct Pair {
  double weight;
  glm::dvec3 current, desired;
};

// A second implementation of g: the weighted dot products after the rotation.
double GainAfter(const std::vector<Pair>& pairs, const glm::dvec3& axis, double phi) {
  double gain = 0;
  for (const Pair& p : pairs) gain += p.weight * glm::dot(p.desired, AxisRotation(axis, phi) * p.current);
  return gain;
}

struct Hinge {
  glm::dvec3 axis;
  std::vector<Pair> pairs;
  HingeGain gain;
};

Hinge RandomHinge(int trial) {
  RandomStream random({.suite_seed = 3, .scenario = "hinge-test", .trial = trial}, "pairs");
  Hinge hinge{glm::normalize(random.Normal3()), {}, {}};
  for (int i = 0; i < 5; ++i) hinge.pairs.push_back({random.Uniform(0.1, 2), random.Normal3(), random.Normal3()});
  for (const Pair& p : hinge.pairs) hinge.gain.Add(p.weight, p.current, p.desired, hinge.axis);
  return hinge;
}

constexpr int kScan = 2000;

TEST(HingeGain, IsWhatTurningReallyGives) {
  for (int trial = 0; trial < 20; ++trial) {
    const Hinge hinge = RandomHinge(trial);
    for (double phi : {-3.0, -1.0, 0.0, 0.4, 2.2}) {
      EXPECT_NEAR(hinge.gain.At(phi), GainAfter(hinge.pairs, hinge.axis, phi), 1e-12);
    }
  }
}

TEST(HingeGain, OptimumBeatsEveryAngleOfAScan) {
  for (int trial = 0; trial < 20; ++trial) {
    const Hinge hinge = RandomHinge(trial);
    const double best = GainAfter(hinge.pairs, hinge.axis, hinge.gain.Optimum());
    double scanned = -1e300;
    for (int i = 0; i <= kScan; ++i) {
      scanned = std::max(scanned, GainAfter(hinge.pairs, hinge.axis, -kPi + 2 * kPi * i / kScan));
    }
    EXPECT_GE(best, scanned - 1e-12);
    EXPECT_LT(best - scanned, 1e-4 * (1 + std::abs(best))) << "the scan must come near, or it checks nothing";
  }
}

TEST(HingeGain, OptimumWithinARangeBeatsEveryAngleOfIt) {
  const AngleRange ranges[] = {{-0.1, 0.3}, {-2, 0}, {0, 0}, {-0.5, 6.0}, {-7, 7}};
  for (int trial = 0; trial < 40; ++trial) {
    const Hinge hinge = RandomHinge(trial);
    for (const AngleRange& range : ranges) {
      const double phi = hinge.gain.OptimumWithin(range);
      EXPECT_GE(phi, range.lower);
      EXPECT_LE(phi, range.upper);
      for (int i = 0; i <= 200; ++i) {
        const double other = range.lower + (range.upper - range.lower) * i / 200;
        EXPECT_GE(hinge.gain.At(phi), hinge.gain.At(other) - 1e-12) << "trial " << trial;
      }
    }
  }
}

TEST(HingeGain, TheOptimumCountsModuloAFullTurn) {
  HingeGain gain;
  gain.Add(1, {1, 0, 0}, {0, -1, 0}, {0, 0, 1});  // a quarter turn back, or three quarters on
  EXPECT_NEAR(gain.Optimum(), -kPi / 2, 1e-15);
  EXPECT_NEAR(gain.OptimumWithin({0, 5}), 1.5 * kPi, 1e-15);
}

TEST(HingeGain, ATieBetweenBothEndsGoesToTheLowerOne) {
  HingeGain gain;
  gain.Add(1, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1});  // half a turn: both directions are equal
  EXPECT_EQ(gain.OptimumWithin({-0.5, 0.5}), -0.5);
}

TEST(HingeGain, AFlatGainTurnsNothing) {
  HingeGain gain;
  gain.Add(1, {0, 0, 2}, {1, 1, 1}, {0, 0, 1});  // the effector lies on the axis
  EXPECT_EQ(gain.OptimumWithin({-1, 1}), 0);
}

}  // namespace
}  // namespace etude
