#include "engine/kinematics/solvers/ccd.h"

#include "engine/kinematics/solvers/ccd_sweep.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/moment_sweep.h"

namespace etude {
namespace {

IkSolution Solve(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options, CcdJoint joint_kind) {
  if (!FindFault(tree, problem, options).empty()) return BadInput(tree);
  IkRun run(tree, problem, options);
  CcdSweep ccd(tree, problem, options, joint_kind);
  run.Note(ccd.errors(), ccd.angles());
  while (run.MustGoOn()) {
    const double change = ccd.Sweep();
    run.Note(ccd.errors(), ccd.angles());
    if (change < options.stall_change) run.Stall();
  }
  return run.Finish({ccd.angles().begin(), ccd.angles().end()});
}

// The same in moment form. Where goals may be met, and where somebody looks, the errors are those of angles.
IkSolution SolveByMoments(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  IkRun run(tree, problem, options);
  TreeState state = problem.start;
  state.angles = run.start_angles();
  TreeFrames frames = ComputeFrames(tree, state);
  run.NoteFrames(frames, state.angles);
  MomentSweep sweep(tree, problem, options);
  while (run.MustGoOn()) {
    const double change = sweep.Sweep();
    const bool is_last = run.iterations() + 1 == options.max_iterations;
    if (run.Traces() || is_last || change < options.stall_change || !sweep.MissesGoals()) {
      state.angles = sweep.Angles();
      ComputeFrames(tree, state, frames);
      run.NoteFrames(frames, state.angles);
    } else {
      run.NoteMisses();
    }
    if (change < options.stall_change) run.Stall();
  }
  return run.Finish(std::move(state.angles));
}

}  // namespace

IkSolution SolveCcd(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  return Solve(tree, problem, options, CcdJoint::kWhole);
}

IkSolution SolveCcdHinges(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  if (!MomentSweep::CanServe(options)) return Solve(tree, problem, options, CcdJoint::kHinges);
  return FindFault(tree, problem, options).empty() ? SolveByMoments(tree, problem, options) : BadInput(tree);
}

}  // namespace etude
