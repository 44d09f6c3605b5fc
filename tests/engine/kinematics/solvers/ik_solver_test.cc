#include "engine/kinematics/solvers/ik_solver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/ccd.h"
#include "tests/engine/kinematics/posed_tree.h"
#include "tests/engine/kinematics/solvers/arms.h"

namespace etude {
namespace {

// A near pose, which every solver must recover.
IkProblem NearProblem(int trial) { return DisturbedProblem(Body(), RandomPose(Body(), trial, 0.5), trial, 3); }
// A far pose near the limits.
IkProblem FarProblem(int trial) { return DisturbedProblem(Body(), RandomPose(Body(), trial, 1.0), trial, 30); }

IkOptions PatientOptions() {
  IkOptions options{.weights = WeightRule::kAdaptivePower, .max_iterations = 2000};
  return options;
}

class EverySolver : public ::testing::TestWithParam<std::string> {
 protected:
  IkSolution Solve(const IkProblem& problem, const IkOptions& options) const {
    return FindIkSolver(GetParam())->solve(Body(), problem, options);
  }

  bool uses_axes() const { return FindIkSolver(GetParam())->uses_axes; }

  // Returns the problem without the parts that the solver ignores.
  IkProblem AsSeen(IkProblem problem) const {
    if (uses_axes()) return problem;
    for (EffectorTarget& target : problem.targets) target.axis_weights = glm::dvec3(0);
    return problem;
  }
};

TEST_P(EverySolver, BringsTheEffectorsHome) {
  for (int trial = 0; trial < 5; ++trial) {
    const IkProblem problem = AsSeen(NearProblem(trial));
    const IkSolution solution = Solve(problem, PatientOptions());
    ASSERT_EQ(solution.status, IkStatus::kConverged) << trial;
    EXPECT_GT(solution.iterations, 0);
    // Judged by this test's own forward kinematics, not by the solver's status.
    const TreeFrames found =
        ComputeFrames(Body(), {problem.start.root_position, problem.start.root_frame, solution.angles});
    for (std::size_t e = 0; e < problem.targets.size(); ++e) {
      EXPECT_LT(glm::distance(found.effectors[e].position, problem.targets[e].position), 0.001);
      const EffectorError error = ErrorOf(found.effectors[e], problem.targets[e]);
      EXPECT_LT(error.MeanAxisAngle(problem.targets[e].axis_weights), Radians(0.1));
      EXPECT_EQ(error.position, solution.errors[e].position);
    }
  }
}

TEST_P(EverySolver, HasNothingToDoAtTheTarget) {
  const IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), 1, 0.5), 1, 0);
  const IkSolution solution = Solve(problem, PatientOptions());
  EXPECT_EQ(solution.status, IkStatus::kConverged);
  EXPECT_EQ(solution.iterations, 0);
  EXPECT_EQ(solution.fk_evaluations, 1);
  EXPECT_EQ(solution.angles, problem.start.angles);
}

TEST_P(EverySolver, AnswersManyAsItAnswersEach) {
  for (const bool traces : {false, true}) {
    IkOptions options{.max_iterations = 30, .trace = traces};
    std::vector<IkProblem> problems;
    for (int trial = 0; trial < 5; ++trial) problems.push_back(FarProblem(trial));
    const std::vector<IkSolution> all = SolveAll(*FindIkSolver(GetParam()), Body(), problems, options);
    ASSERT_EQ(all.size(), problems.size());
    for (std::size_t i = 0; i < problems.size(); ++i) {
      const IkSolution each = Solve(problems[i], options);
      EXPECT_EQ(all[i].angles, each.angles);
      EXPECT_EQ(all[i].status, each.status);
      EXPECT_EQ(all[i].iterations, each.iterations);
      EXPECT_EQ(all[i].trace.size(), each.trace.size());
    }
  }
}

TEST_P(EverySolver, AnswersPreparedAsItAnswersEach) {
  const auto prepared = Prepare(*FindIkSolver(GetParam()), Body());
  IkProblem bad = FarProblem(0);
  bad.start.angles[0] = std::numeric_limits<double>::quiet_NaN();
  for (int round = 0; round < 2; ++round) {
    for (int trial = 0; trial < 6; ++trial) {
      IkOptions options{.max_iterations = 30, .trace = trial == 2};
      options.limits = trial != 3;
      if (trial == 4) options.angle_change_tolerance = 0.1;
      const IkProblem problem = trial == 1 ? bad : FarProblem(trial);
      const IkSolution each = Solve(problem, options), found = prepared->Solve(problem, options);
      EXPECT_EQ(found.angles, each.angles) << trial;
      EXPECT_EQ(found.status, each.status);
      EXPECT_EQ(found.iterations, each.iterations);
      EXPECT_EQ(found.fk_evaluations, each.fk_evaluations);
      EXPECT_EQ(found.trace.size(), each.trace.size());
    }
  }
  KinematicTree faulty = Body();
  faulty.joints[1].parent = 1;
  EXPECT_EQ(Prepare(*FindIkSolver(GetParam()), faulty)->Solve(FarProblem(0), {}).status, IkStatus::kBadInput);
}

TEST_P(EverySolver, NeverLeavesTheLimits) {
  IkOptions options{.max_iterations = 60, .trace = true};
  int checked = 0;
  for (int trial = 0; trial < 8; ++trial) {
    for (const IkTraceEntry& entry : Solve(FarProblem(trial), options).trace) {
      for (std::size_t i = 0; i < entry.angles.size(); ++i, ++checked) {
        EXPECT_GE(entry.angles[i], Body().limits[i].lower);
        EXPECT_LE(entry.angles[i], Body().limits[i].upper);
      }
    }
  }
  EXPECT_GT(checked, 1000);
}

TEST_P(EverySolver, CrossesTheLimitsWhenTheyAreOff) {
  int outside = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const IkSolution solution = Solve(FarProblem(trial), {.limits = false, .max_iterations = 60});
    for (std::size_t i = 0; i < solution.angles.size(); ++i) {
      outside += solution.angles[i] < Body().limits[i].lower || solution.angles[i] > Body().limits[i].upper;
    }
  }
  EXPECT_GT(outside, 0) << "else the test of the limits proves nothing";
}

TEST_P(EverySolver, KeepsEveryAngleInTheToleranceAroundItsStart) {
  IkOptions options{.angle_change_tolerance = Radians(4), .max_iterations = 60};
  for (int trial = 0; trial < 8; ++trial) {
    const IkProblem problem = FarProblem(trial);
    const IkSolution solution = Solve(problem, options);
    double largest = 0;
    for (std::size_t i = 0; i < solution.angles.size(); ++i) {
      largest = std::max(largest, std::abs(solution.angles[i] - problem.start.angles[i]));
    }
    EXPECT_LE(largest, Radians(4) + 1e-12);
    EXPECT_GT(largest, Radians(3.9)) << "so large a disturbance must run into the tolerance";
  }
}

TEST_P(EverySolver, FollowsDirectionsAloneWhenOtherAxesHaveNoWeight) {
  IkProblem problem = NearProblem(2);
  for (EffectorTarget& target : problem.targets) {
    target.axis_weights = {0, 0, 1};
    // X and Y are wrong: turned about Z by a right angle.
    target.axes = {target.axes[1], -target.axes[0], target.axes[2]};
  }
  const IkSolution solution = Solve(problem, PatientOptions());
  EXPECT_EQ(solution.status == IkStatus::kConverged, uses_axes()) << "positions only is no excuse for a wrong status";
}

TEST_P(EverySolver, SaysWhenItRanOutOfIterations) {
  IkOptions options = PatientOptions();
  options.max_iterations = 1;
  options.trace = true;
  const IkSolution solution = Solve(FarProblem(0), options);
  EXPECT_EQ(solution.status, IkStatus::kIterationLimit);
  EXPECT_EQ(solution.iterations, 1);
  EXPECT_EQ(solution.trace.size(), 2u) << "the start and one iteration";
}

TEST_P(EverySolver, ComesToTheSameWhateverIsTraced) {
  for (const int max_iterations : {1, 40, 3000}) {
    IkOptions untraced = PatientOptions();
    untraced.max_iterations = max_iterations;
    IkOptions traced = untraced, partly = untraced;
    traced.trace = partly.trace = true;
    partly.max_trace_entries = 20;
    for (int trial = 0; trial < 4; ++trial) {
      const IkSolution none = Solve(FarProblem(trial), untraced), all = Solve(FarProblem(trial), traced);
      const IkSolution some = Solve(FarProblem(trial), partly);
      EXPECT_TRUE(none.trace.empty());
      EXPECT_EQ(all.trace.size(), static_cast<std::size_t>(all.iterations) + 1);
      EXPECT_EQ(some.trace.size(), std::min<std::size_t>(all.trace.size(), 20));
      for (const IkSolution* solution : {&none, &some}) {
        EXPECT_EQ(solution->angles, all.angles);
        EXPECT_EQ(solution->status, all.status);
        EXPECT_EQ(solution->iterations, all.iterations);
        EXPECT_EQ(solution->fk_evaluations, all.fk_evaluations);
        for (std::size_t e = 0; e < all.errors.size(); ++e) {
          EXPECT_EQ(solution->errors[e].position, all.errors[e].position);
          EXPECT_EQ(solution->errors[e].axis_angles, all.errors[e].axis_angles);
        }
      }
    }
  }
}

TEST_P(EverySolver, StallsAtATargetOutOfReach) {
  IkProblem problem = NearProblem(0);
  for (EffectorTarget& target : problem.targets) target.axis_weights = glm::dvec3(0);
  problem.targets[3].position += glm::dvec3(0, 5, 0);
  IkOptions options{.weights = WeightRule::kFixed, .max_iterations = 20000};
  const IkSolution solution = Solve(problem, options);
  EXPECT_EQ(solution.status, IkStatus::kUnreachable);
  for (double angle : solution.angles) EXPECT_TRUE(std::isfinite(angle));
}

TEST_P(EverySolver, AnswersBadInputWithAStatusAndFiniteAngles) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const std::vector<void (*)(KinematicTree&, IkProblem&, IkOptions&)> faults = {
      [](KinematicTree& t, IkProblem&, IkOptions&) { t.joints.clear(); },
      [](KinematicTree& t, IkProblem&, IkOptions&) { t.joints[kTreeLeftKnee].parent = kTreeLeftHip; },
      [](KinematicTree& t, IkProblem&, IkOptions&) { t.joints[kTreeNavel].parent = -1; },
      [](KinematicTree& t, IkProblem&, IkOptions&) { t.joints[kTreeRightAnkle].first_dof = 28; },
      [](KinematicTree& t, IkProblem&, IkOptions&) { t.joints[kTreeNeck].first_dof = t.joints[kTreeNavel].first_dof; },
      [](KinematicTree& t, IkProblem&, IkOptions&) { t.joints[kTreeNeck].R_PJ[1].y = kNaN; },
      [](KinematicTree& t, IkProblem&, IkOptions&) { t.effectors[2].joint = kBodyTreeJointCount; },
      [](KinematicTree&, IkProblem& p, IkOptions&) { p.start.angles[5] = kNaN; },
      [](KinematicTree&, IkProblem& p, IkOptions&) { p.start.angles.pop_back(); },
      [](KinematicTree&, IkProblem& p, IkOptions&) { p.start.root_position.x = kInfinite; },
      [](KinematicTree&, IkProblem& p, IkOptions&) { p.start.root_frame[1] = glm::dvec3(0); },
      [](KinematicTree&, IkProblem& p, IkOptions&) { p.targets[2].position.z = kNaN; },
      [](KinematicTree&, IkProblem& p, IkOptions&) { p.targets[2].position.z = 1e200; },
      [](KinematicTree&, IkProblem& p, IkOptions&) { p.targets[0].axes[2] *= 2.0; },
      [](KinematicTree&, IkProblem& p, IkOptions&) { p.targets[0].axis_weights.y = -1; },
      [](KinematicTree&, IkProblem& p, IkOptions&) { p.targets[1].position_weight = kNaN; },
      [](KinematicTree&, IkProblem& p, IkOptions&) { p.targets.pop_back(); },
      [](KinematicTree&, IkProblem& p, IkOptions&) { std::swap(p.limits[3].lower, p.limits[3].upper); },
      [](KinematicTree&, IkProblem& p, IkOptions&) { p.limits[3].upper = kNaN; },
      [](KinematicTree& t, IkProblem&, IkOptions&) { t.joints[kTreeLeftKnee].p_PJ = glm::dvec3(0); },
      [](KinematicTree& t, IkProblem&, IkOptions&) { t.effectors[1].p_LE.z = kNaN; },
      [](KinematicTree&, IkProblem&, IkOptions& o) { o.angle_change_tolerance = -0.1; },
      [](KinematicTree&, IkProblem&, IkOptions& o) { o.max_iterations = 0; },
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    KinematicTree tree = Body();
    IkProblem problem = NearProblem(0);
    IkOptions options;
    ASSERT_EQ(FindFault(tree, problem, options), "") << "sound before the fault";
    faults[i](tree, problem, options);
    EXPECT_NE(FindFault(tree, problem, options), "") << "fault " << i;
    const IkSolution solution = FindIkSolver(GetParam())->solve(tree, problem, options);
    EXPECT_EQ(solution.status, IkStatus::kBadInput) << "fault " << i;
    EXPECT_EQ(solution.angles, std::vector<double>(29, 0.0));
  }
}

TEST_P(EverySolver, EndsOnATreeThatCannotMove) {
  KinematicTree rod{.joints = {{.name = "root"}, {.name = "fixed", .parent = 0, .p_PJ = {0, 0, 1}}}};
  rod.effectors = {{"tip", 1, {0, 0, 0.5}}};
  IkProblem problem = DisturbedProblem(rod, StandingState(rod), 0, 0);
  if (!FindIkSolver(GetParam())->uses_axes) problem.targets[0].axis_weights = glm::dvec3(0);
  EXPECT_EQ(FindIkSolver(GetParam())->solve(rod, problem, IkOptions{}).status, IkStatus::kConverged);
  problem.targets[0].position += glm::dvec3(0.1, 0, -0.1);
  const IkSolution missed = FindIkSolver(GetParam())->solve(rod, problem, IkOptions{});
  EXPECT_NE(missed.status, IkStatus::kConverged);
  EXPECT_NE(missed.status, IkStatus::kBadInput);
  EXPECT_NEAR(missed.errors[0].position, 0.1 * std::sqrt(2), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Solvers, EverySolver, ::testing::ValuesIn(IkSolverNames()), [](const auto& tested) {
  std::string name = tested.param;
  std::erase(name, '-');
  return name;
});

TEST(Solvers, FindTheAnglesOfTwoHingesByTheLawOfCosines) {
  const KinematicTree arm = Arm({0.5, 0.4}, 1);
  const glm::dvec3 place = TwoHingeTip(0.5, 0.4, 0.7, 1.2);
  for (const char* name : {"damped-least-squares", "fabrik", "jacobian-transpose", "levenberg-marquardt"}) {
    const IkSolution solution = FindIkSolver(name)->solve(arm, Reach(arm, {0.4, 1.5}, place), Exactly());
    EXPECT_EQ(solution.status, IkStatus::kConverged) << name;
    EXPECT_NEAR(solution.angles[0], 0.7, 1e-8) << name;
    EXPECT_NEAR(solution.angles[1], ElbowAngle(0.5, 0.4, glm::distance(place, {0, 0, 1})), 1e-8) << name;
  }
}

TEST(Solvers, AreFoundByName) {
  EXPECT_THAT(IkSolverNames(), ::testing::IsSupersetOf({"ccd", "ccd-hinges", "gauss-newton", "levenberg-marquardt",
                                                        "damped-least-squares", "damped-least-squares-active-set",
                                                        "jacobian-pinv", "jacobian-transpose", "fabrik"}));
  EXPECT_EQ(FindIkSolver("cdc"), nullptr);
}

TEST(Solvers, TellTheNewNameOfOneThatWasRenamed) {
  EXPECT_EQ(FindIkSolver("ccd-nullspace"), nullptr);
  EXPECT_EQ(NewNameOfIkSolver("ccd-nullspace"), "gauss-newton");
  EXPECT_NE(FindIkSolver(NewNameOfIkSolver("ccd-nullspace")), nullptr);
  EXPECT_EQ(NewNameOfIkSolver("gauss-newton"), "");
}

TEST(Solvers, TakeTheSettingsThatTheyDescribe) {
  int settings = 0;
  for (const IkSolver& solver : AllIkSolvers()) {
    IkOptions by_default = PatientOptions(), described = by_default;
    by_default.max_iterations = described.max_iterations = 8;
    for (const auto& [number, set] : solver.settings) set(described.solver_settings, number.fallback);
    const std::vector<double> angles = solver.solve(Body(), FarProblem(1), by_default).angles;
    EXPECT_EQ(solver.solve(Body(), FarProblem(1), described).angles, angles) << solver.name;
    for (const auto& [setting, set] : solver.settings) {
      ++settings;
      EXPECT_TRUE(setting.fallback >= setting.lowest && setting.fallback <= setting.largest) << setting.key;
      IkOptions changed = described;
      set(changed.solver_settings, setting.fallback == setting.largest ? setting.lowest : setting.largest);
      EXPECT_NE(solver.solve(Body(), FarProblem(1), changed).angles, angles) << solver.name << ", " << setting.key;
    }
  }
  EXPECT_GE(settings, 8);  // or no solver had settings
}

TEST(Solvers, TakeSettingsInTheRangesThatAreDocumented) {
  struct Range {
    std::string solver, key;
    double lowest, largest;
    bool is_whole = false;
  };
  const std::vector<Range> documented = {
      {"ccd-anderson", "memory", 1, 20, true},
      {"gauss-newton", "first_sweeps", 0, 100, true},
      {"levenberg-marquardt", "damping_share", 0.000001, 1000},
      {"ceres-lm", "first_radius", 0.000001, 1'000'000'000'000},
      {"damped-least-squares", "damping", 0.000000001, 1'000'000},
      {"damped-least-squares-active-set", "damping", 0.000000001, 1'000'000},
      {"jacobian-pinv", "pinv_damping", 0, 100},
      {"jacobian-transpose", "gain", 0.01, 2},
  };
  std::size_t found = 0;
  for (const IkSolver& solver : AllIkSolvers()) {
    for (const auto& [setting, set] : solver.settings) {
      ASSERT_LT(found, documented.size());
      const Range& range = documented[found++];
      EXPECT_EQ(solver.name, range.solver);
      EXPECT_EQ(setting.key, range.key) << solver.name;
      EXPECT_EQ(setting.lowest, range.lowest) << solver.name;
      EXPECT_EQ(setting.largest, range.largest) << solver.name;
      EXPECT_EQ(setting.is_whole, range.is_whole) << solver.name;
    }
  }
  EXPECT_EQ(found, documented.size());
}

}  // namespace
}  // namespace etude
