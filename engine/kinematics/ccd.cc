#include "engine/kinematics/ccd.h"

#include "engine/kinematics/ccd_sweep.h"

namespace etude {
namespace {

IkSolution Solve(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options, CcdJoint joint_kind) {
  IkSolution solution;
  if (!FindFault(tree, problem, options).empty()) {
    solution.angles.assign(tree.limits.size(), 0.0);
    return solution;
  }
  CcdSweep ccd(tree, problem, options, joint_kind);
  const auto note = [&](const WorstError& worst) {
    if (!options.trace) return;
    solution.trace.push_back({worst.position, worst.axis, {ccd.angles().begin(), ccd.angles().end()}});
  };
  WorstError worst = FindWorst(ccd.errors(), problem.targets);
  note(worst);
  solution.status = IkStatus::kIterationLimit;
  bool stalled = false;
  while (!worst.Within(options) && !stalled && solution.iterations < options.max_iterations) {
    stalled = ccd.Sweep() < options.stall_change;
    ++solution.iterations;
    worst = FindWorst(ccd.errors(), problem.targets);
    note(worst);
  }
  if (stalled) solution.status = IkStatus::kStalled;
  if (worst.Within(options)) solution.status = IkStatus::kConverged;
  solution.angles.assign(ccd.angles().begin(), ccd.angles().end());
  solution.errors.assign(ccd.errors().begin(), ccd.errors().end());
  solution.fk_evaluations = ccd.fk_evaluations();
  return solution;
}

}  // namespace

IkSolution SolveCcd(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  return Solve(tree, problem, options, CcdJoint::kWhole);
}

IkSolution SolveCcdHinges(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  return Solve(tree, problem, options, CcdJoint::kHinges);
}

}  // namespace etude
