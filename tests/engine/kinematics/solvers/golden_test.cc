// Golden values of whole results: what the other tests say is right they say of answers; here every number on the way
// counts, from few iterations that show where a solver begins, how it damps and when it gives up.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "engine/kinematics/solvers/ccd.h"
#include "engine/kinematics/solvers/fabrik.h"
#include "engine/kinematics/solvers/gauss_newton.h"
#include "engine/kinematics/solvers/gauss_newton_plain.h"
#include "engine/kinematics/solvers/gauss_newton_tree.h"
#include "engine/kinematics/solvers/gauss_newton_vectors.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/ik_solver.h"
#include "engine/kinematics/solvers/jacobian_solvers.h"
#include "engine/kinematics/solvers/linear_targets.h"
#include "engine/kinematics/solvers/sweep_tree.h"
#include "tests/engine/kinematics/solvers/arms.h"
#include "tests/engine/kinematics/solvers/random_problem.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Dice;
using testing::Fingerprint;
using Kept = std::pair<std::size_t, double>;

void AddErrors(const std::vector<EffectorError>& errors, Fingerprint& print) {
  print.Add(errors.size());
  for (const EffectorError& error : errors) print.Add(error.position).Add(error.axis_angles);
}

void AddSolution(const IkSolution& solution, Fingerprint& print) {
  print.Add(solution.status).Add(solution.iterations).Add(solution.fk_evaluations).Add(solution.angles);
  AddErrors(solution.errors, print);
  for (const IkTraceEntry& entry : solution.trace) {
    print.Add(entry.worst_position).Add(entry.worst_axis).Add(entry.worst_mean_axis).Add(entry.angles);
    AddErrors(entry.errors, print);
  }
}

// A body off by 15°, one end of which is out of the way, and whose targets do not all count.
IkProblem UnevenBodyProblem(int trial) {
  IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), trial, 0.9), trial, 15);
  problem.targets[trial % 4].axis_weights = {0.5, 0, 2};
  problem.targets[(trial + 1) % 4].position_weight = 0.4;
  if (trial == 3) problem.targets[1].position += glm::dvec3(0.1, 0.05, -0.1);
  return problem;
}

// Each solver: the body's first steps traced, any tree to its end, and both again by other settings.
struct SolverGolden {
  Kept first_steps, any_tree, other_settings;
};

Fingerprint FirstSteps(const IkSolver& solver) {
  Fingerprint print;
  for (const WeightRule rule : {WeightRule::kAdaptive, WeightRule::kFixedTuned, WeightRule::kWangChen,
                                WeightRule::kAdaptivePower, WeightRule::kAdaptiveTuned}) {
    for (const WeightRefresh refresh : {WeightRefresh::kSweep, WeightRefresh::kJoint, WeightRefresh::kDof}) {
      const bool by_default = rule == WeightRule::kAdaptive && refresh == WeightRefresh::kSweep;
      if (!by_default && !solver.uses_weights) continue;
      for (int trial = 0; trial < (solver.uses_weights ? 1 : 4); ++trial) {
        IkOptions options;
        options.weights = rule;
        options.refresh = refresh;
        options.max_iterations = 3;
        options.trace = true;
        AddSolution(solver.solve(Body(), UnevenBodyProblem(trial), options), print);
      }
    }
  }
  return print;
}

Fingerprint OnAnyTree(const IkSolver& solver, bool by_default) {
  Fingerprint print;
  for (int trial = 0; trial < 60; ++trial) {
    const auto made = MakeRandomProblem(trial);
    if (!made) continue;
    IkOptions options = made->options;
    // Extrapolation makes much of rounding where nothing moves any more.
    options.max_iterations = 1 + trial % (solver.name == "ccd-anderson" ? 5 : 18);
    options.trace = trial % 4 == 1;
    if (!by_default) {
      options.limits = trial % 5 != 0;
      options.position_goal = 0.05;
      options.axis_goal = 0.1;
      options.stall_change = 1e-3;
      options.longest_trace = 3;
      for (const auto& [number, set] : solver.settings) {
        set(options.solver_settings, number.is_whole ? 3 : number.fallback * 0.4 + 0.01);
      }
    }
    AddSolution(solver.solve(made->tree, made->problem, options), print);
  }
  return print;
}

TEST(KinematicsSolvers, GoldenAnswersOfEverySolver) {
  const std::map<std::string, SolverGolden> kept = {
      {"ccd", {{3750, 277.079626007}, {4977, 334.877871253}, {3263, 2.29786722627}}},
      {"ccd-hinges", {{3750, 278.229209125}, {3716, 40.7727042322}, {3227, 31.2264440492}}},
      {"ccd-anderson", {{3750, 279.313231892}, {3438, 127.273345632}, {3128, -11.7041415086}}},
      {"gauss-newton", {{1000, 151.799334901}, {5923, 167.546975386}, {3227, 19.1854079461}}},
      {"levenberg-marquardt", {{1000, 151.367025929}, {5834, 158.78631655}, {3227, -20.1301395201}}},
      {"ceres-lm", {{1000, 151.55200645}, {4956, 104.986879919}, {3194, -9.53807544833}}},
      {"damped-least-squares", {{1000, 151.551437173}, {5132, 32.1641761986}, {3227, 17.9809398776}}},
      {"damped-least-squares-active-set", {{1000, 148.362905375}, {3572, 142.092392845}, {3227, 14.5918888146}}},
      {"fabrik", {{1000, 145.531138729}, {4528, 4.04744727947}, {3239, 32.2599413115}}},
      {"jacobian-pinv", {{1000, 149.881850957}, {2379, 141.457365524}, {3227, 22.5605764916}}},
      {"jacobian-transpose", {{1000, 151.157154706}, {5635, -66.0557834745}, {3287, -64.3266468943}}},
  };
  for (const IkSolver& solver : AllIkSolvers()) {
    ASSERT_TRUE(kept.contains(solver.name));
    const SolverGolden& golden = kept.at(solver.name);
    EXPECT_TRUE(FirstSteps(solver).Is(golden.first_steps.first, golden.first_steps.second)) << solver.name;
    EXPECT_TRUE(OnAnyTree(solver, true).Is(golden.any_tree.first, golden.any_tree.second)) << solver.name;
    EXPECT_TRUE(OnAnyTree(solver, false).Is(golden.other_settings.first, golden.other_settings.second)) << solver.name;
  }
}

// Long enough that steps get stuck, restarts run out and settling stalls.
TEST(KinematicsSolvers, GoldenWaysWhereTargetsCannotBeMet) {
  const std::map<std::string, Kept> kept = {{"gauss-newton", {2220, 135.694725024}},
                                            {"levenberg-marquardt", {2220, 147.237480054}}};
  for (const auto& [name, golden] : kept) {
    Fingerprint print;
    for (int trial = 0; trial < 6; ++trial) {
      KinematicTree arm = Arm({0.5, 0.4, 0.2}, 2);
      IkProblem problem = DisturbedProblem(arm, RandomPose(arm, trial, 0.5), trial, 20);
      for (AngleRange& range : problem.limits) range = {-0.5, 0.4};
      problem.targets[0].axes = {problem.targets[0].axes[1], problem.targets[0].axes[2], problem.targets[0].axes[0]};
      if (trial == 5) problem.targets[0].position *= 3.0;
      IkOptions options;
      options.max_iterations = 40 + 60 * trial;
      options.trace = trial < 2;
      AddSolution(FindIkSolver(name)->solve(arm, problem, options), print);
    }
    EXPECT_TRUE(print.Is(golden.first, golden.second)) << name;
  }
}

TEST(KinematicsSolvers, GoldenBatches) {
  std::vector<IkProblem> problems;
  for (int trial = 0; trial < 13; ++trial) problems.push_back(UnevenBodyProblem(trial));
  problems[4].limits[2] = {1, -1};
  problems[7].targets[0].position += glm::dvec3(0, 9, 0);
  Fingerprint print;
  for (const Precision precision : {Precision::kFloat, Precision::kDouble}) {
    for (const GaussNewtonOptions& own :
         {GaussNewtonOptions{}, {.first_sweeps = 2, .extra_passes = 1, .restarts = 2}}) {
      for (const int iterations : {3, 12}) {
        IkOptions options;
        options.max_iterations = iterations;
        options.position_goal = 5e-4;
        if (own.restarts == 2) options.angle_change_tolerance = 0.4;
        for (const IkSolution& solution : SolveGaussNewtonBatch(Body(), problems, options, precision, own)) {
          AddSolution(solution, print);
        }
      }
    }
  }
  EXPECT_TRUE(print.Is(5072, -240.147775246));
}

TEST(KinematicsSolvers, GoldenRulesOfGaussNewton) {
  Fingerprint print;
  for (const double goal : {1e-14, 1e-5, 0.001, 0.3, 5.0}) {
    IkOptions options;
    options.position_goal = goal;
    options.axis_goal = 2 * goal;
    for (const Precision precision : {Precision::kFloat, Precision::kDouble}) {
      const GaussNewtonRules rules = RulesFor(options, {.extra_passes = 5}, precision);
      for (const double square : {rules.squared_distance_met, rules.squared_distance_missed, rules.squared_chord_met,
                                  rules.squared_chord_missed}) {
        const double share = std::sqrt(square) / goal;
        print.Add(share).Add(precision == Precision::kDouble && std::abs(share - 1) < 1e-3 ? 1e9 * (1 - share) : 0.0);
      }
      print.Add(rules.extra_passes).Add(rules.largest_turn);
    }
  }
  IkOptions asked;
  asked.limits = false;
  asked.angle_change_tolerance = 1;
  const IkOptions sweeps = GaussNewtonSweepOptions(asked);
  print.Add(sweeps.weights).Add(sweeps.refresh).Add(sweeps.limits).Add(sweeps.angle_change_tolerance);
  EXPECT_TRUE(print.Is(104, 6.12214618326));
}

TEST(KinematicsSolvers, GoldenTreesInTheOrderOfTheirUse) {
  Fingerprint lanes, limbs, sweeps;
  std::vector<KinematicTree> trees = {Body(), Arm({0.5, 0.4, 0.2}, 3)};
  for (int trial = 0; trial < 12; ++trial) trees.push_back(RandomTree(trial, 2 + 2 * trial));
  for (const KinematicTree& tree : trees) {
    lanes.Add(JointHeights(tree)).Add(JointsInwards(tree));
    const GaussNewtonTree made(tree);
    for (const auto& joint : made.joints) {
      lanes.Add(joint.parent).Add(joint.first_dof).Add(joint.dof_count).Add(joint.renames_axes).Add(joint.p_PJ);
      lanes.Add(joint.from).Add(joint.sign).Add(joint.R_PJ).Add(joint.quadratic);
    }
    for (const auto& effector : made.effectors) lanes.Add(effector.joint).Add(effector.p_LE).Add(effector.is_first);
    for (const auto& [joint, dof] : made.steps) lanes.Add(joint).Add(dof);
    lanes.Add(made.inwards).Add(made.unasked).Add(made.quadratic_count).Add(made.dof_count);

    const LimbPacks packs(tree);
    for (const auto& [parents, first, count] : packs.packs) limbs.Add(parents).Add(first).Add(count);
    for (const auto& [R_PJ, p_PJ, has_hinge, turns_axes, hinges, first, ends] : packs.levels) {
      limbs.Add(R_PJ).Add(p_PJ).Add(has_hinge).Add(turns_axes).Add(hinges).Add(first).Add(ends);
    }
    for (const auto& [p_LE, effectors] : packs.ends) limbs.Add(p_LE).Add(effectors);
    for (const auto& [parent, R_PJ, p_PJ, first_hinge, hinges, first_branch, branches] : packs.trunk) {
      limbs.Add(parent).Add(R_PJ).Add(p_PJ).Add(first_hinge).Add(hinges).Add(first_branch).Add(branches);
    }
    for (const auto& [pack, number] : packs.branches) limbs.Add(pack).Add(number);
    limbs.Add(packs.inwards).Add(packs.places).Add(packs.end_places).Add(packs.slot_count);
    limbs.Add(packs.trunk_hinge_count).Add(packs.first_trunk_place).Add(packs.place_count);

    const SweepTree sweep(tree);
    for (const auto& [parent, moments, is_first, is_aligned, base, axes, R_PJ, p_PJ] : sweep.joints) {
      sweeps.Add(parent).Add(moments).Add(is_first).Add(is_aligned).Add(base).Add(axes).Add(R_PJ).Add(p_PJ);
    }
    for (const auto& [joint, is_first, p_LE, names, signs] : sweep.effectors) {
      sweeps.Add(joint).Add(is_first).Add(p_LE).Add(names).Add(signs);
    }
    for (const auto& [joint, hinge, i, j, from, towards, turned] : sweep.steps) {
      sweeps.Add(joint).Add(hinge).Add(i).Add(j).Add(from).Add(towards).Add(turned);
    }
    sweeps.Add(sweep.axis_count).Add(sweep.moments_count);
  }
  EXPECT_TRUE(lanes.Is(6837, -357.809423105));
  EXPECT_TRUE(limbs.Is(7582, -76.3013461481));
  EXPECT_TRUE(sweeps.Is(7378, -1182.09988789));
}

TEST(KinematicsSolvers, GoldenStepsAndSweeps) {
  Fingerprint linear_print, dense_print, plain_print, sweep_print;
  for (int trial = 0; trial < 24; ++trial) {
    const auto made = MakeRandomProblem(trial);
    if (!made) continue;
    auto [tree, problem, options] = *made;
    const IkRun run(tree, problem, options);
    TreeState state = problem.start;
    state.angles = run.start_angles();
    const TreeFrames frames = ComputeFrames(tree, state);
    LinearTargets linear(tree, problem.targets);
    linear.Build(frames);
    linear_print.Add(linear.rows()).Add(linear.jacobian()).Add(linear.residuals()).Add(linear.Cost(frames));

    DampedInverse dense;
    dense.Build(linear);
    std::vector<double> preferred(state.angles.size()), step;
    for (std::size_t d = 0; d < preferred.size(); ++d) preferred[d] = 0.1 * static_cast<double>(d % 3) - 0.1;
    for (const double damping : {0.0, 1e-3, 0.3}) {
      const bool is_there = dense.Step(damping, preferred, step);
      dense_print.Add(is_there);
      if (is_there) dense_print.Add(step).Add(dense.Gain(step));
      const bool is_within = dense.StepWithin(damping, preferred, state.angles, run.ranges(), step);
      dense_print.Add(is_within);
      if (is_within) dense_print.Add(step).Add(dense.is_exact());
    }

    GaussNewtonStep plain(tree, problem.targets);
    plain_print.Add(plain.Build(frames));
    for (const double damping : {1e-4, 1e-4, 1e-4, 0.2, 0.2}) {
      plain_print.Add(plain.Solve(state.angles, state.angles, run.ranges(), damping)).Add(plain.is_exact());
    }

    options.weights = static_cast<WeightRule>(trial % 5);
    options.limits = trial % 4 != 0;
    CcdSweep sweep(tree, problem, options, trial % 2 == 0 ? CcdJoint::kWhole : CcdJoint::kHinges);
    for (int i = 0; i < 3; ++i) sweep_print.Add(sweep.Sweep()).Add(1e-6 * sweep.Merit()).Add(sweep.angles());
  }
  EXPECT_TRUE(linear_print.Is(5219, -145.046030591));
  EXPECT_TRUE(dense_print.Is(1312, -45.7442910948));
  EXPECT_TRUE(plain_print.Is(1484, 1222.34694216));
  EXPECT_TRUE(sweep_print.Is(948, -90.1800517745));
}

TEST(KinematicsSolvers, GoldenTurnsMixesAndScatters) {
  Fingerprint print;
  Dice dice(5);
  for (int count = 1; count < 6; ++count) {
    std::vector<glm::dvec3> from, to;
    for (int i = 0; i < count; ++i) from.push_back(dice.Vector()), to.push_back(dice.Vector());
    const glm::dmat3 turn = BestTurn(from, to);
    print.Add(turn[0]).Add(turn[1]).Add(turn[2]);
  }
  for (const int memory : {0, 1, 3, 4}) {
    AndersonMixing mixing(7, memory);
    std::vector<double> x(7), g(7), out(7);
    for (int i = 0; i < 9; ++i) {
      for (double& number : x) number = dice.Signed();
      for (double& number : g) number = dice.Signed();
      mixing.Extrapolate(x, g, out);
      print.Add(out);
      if (i == 5) mixing.Discard();
    }
  }
  std::vector<double> angles;
  for (int number = 1; number < 5; ++number) {
    ScatterAround(std::vector<double>{0.3, -0.8, 0.11, 0},
                  std::vector<AngleRange>{{-2, 2}, {-1, 0}, {-2, 2}, {-.1, .2}}, number, angles);
    print.Add(angles);
  }
  EXPECT_TRUE(print.Is(353, -31.3984574808));
}

}  // namespace
}  // namespace etude
