#include "engine/kinematics/solvers/ccd.h"

#include "engine/kinematics/solvers/ccd_sweep.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/moment_sweep.h"
#include "engine/kinematics/solvers/sweep_loop.h"

namespace etude {
namespace {

IkSolution Solve(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options, CcdJoint joint_kind) {
  if (!FindFault(tree, problem, options).empty()) return BadInput(tree);
  IkRun run(tree, problem, options);
  CcdSweep ccd(tree, problem, options, joint_kind);
  run.Record(ccd.errors(), ccd.angles());
  while (run.MustGoOn()) {
    const double change = ccd.Sweep();
    run.Record(ccd.errors(), ccd.angles());
    if (change < options.stall_change) run.Stall();
  }
  return run.Finish({ccd.angles().begin(), ccd.angles().end()});
}

}  // namespace

IkSolution SolveCcd(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  return Solve(tree, problem, options, CcdJoint::kWhole);
}

IkSolution SolveCcdHinges(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  if (!MomentSweep::CanServe(options)) return Solve(tree, problem, options, CcdJoint::kHinges);
  return RunSweeps<MomentSweep>(tree, problem, options, [](MomentSweep& sweep, IkRun&) { return sweep.Sweep(); });
}

}  // namespace etude
