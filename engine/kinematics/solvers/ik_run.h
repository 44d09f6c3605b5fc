#pragma once

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"

namespace etude {

/// Sets `out` to the errors of all effectors at the pose whose coordinate frames are `frames`.
void MeasureErrors(const TreeFrames& frames, std::span<const EffectorTarget> targets, std::vector<EffectorError>& out);

/// Sets `out` to the errors of all effectors of `problem` at `angles`.
void MeasurePose(const KinematicTree& tree, const IkProblem& problem, std::span<const double> angles,
                 std::vector<EffectorError>& out);

/// The bookkeeping of one solver run: ranges of the angles, stopping criteria, trace and status. `tree` and `problem`
/// must be free of faults (`FindFault`) and outlive this object. `RunFromStart` shows its use.
class IkRun {
 public:
  IkRun(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

  const std::vector<AngleRange>& ranges() const { return ranges_; }
  /// Returns the problem's start angles, clamped to their ranges.
  const std::vector<double>& start_angles() const { return start_angles_; }

  /// Records the start at the first call, and later the result of each iteration. `errors` are those of the pose
  /// `angles`. `angles` is a list, or a function that returns a list and is called only for a trace. `fk_evaluations`
  /// is the number of forward-kinematics passes since the last record.
  template <class Angles>
  void Record(std::span<const EffectorError> errors, const Angles& angles, int fk_evaluations = 1) {
    RecordErrors(errors, fk_evaluations);
    if (!Traces()) return;
    IkTraceEntry& entry = solution_.trace.emplace_back();
    entry.worst_position = worst_.position;
    entry.worst_axis = worst_.axis;
    entry.worst_mean_axis = WorstMeanAxis();
    entry.errors = solution_.errors;
    if constexpr (requires { angles(); }) {
      entry.angles = angles();
    } else {
      entry.angles.assign(angles.begin(), angles.end());
    }
  }

  /// Records an iteration whose pose has the frames `frames`, for solvers that do not need errors themselves. Errors
  /// are computed only for a trace, near the goals, and at the end.
  template <class Angles>
  void RecordFrames(const TreeFrames& frames, const Angles& angles) {
    if (!Traces() && MissesByFar(frames)) {
      RecordMisses();
      return;
    }
    MeasureErrors(frames, problem_.targets, errors_);
    Record(errors_, angles);
  }

  /// Returns true if the next record enters the trace.
  bool Traces() const { return options_.trace && std::ssize(solution_.trace) < options_.max_trace_entries; }

  /// Records an iteration without its errors. The pose must certainly miss the goals, and `Traces()` must return false.
  void RecordMisses();

  /// Counts a forward-kinematics pass beyond the one pass per iteration.
  void CountPass() { ++solution_.fk_evaluations; }
  /// Records that the solver has stalled.
  void Stall() { has_stalled_ = true; }

  /// Records that the solution is not the pose recorded last; `Finish` then measures the errors of the solution with
  /// one more pass.
  void DiscardErrors();

  bool HasConverged() const { return worst_.Within(options_); }
  bool MustGoOn() const { return !HasConverged() && !has_stalled_ && solution_.iterations < options_.max_iterations; }
  int iterations() const { return solution_.iterations; }

  /// Ends the run and returns the solution. `angles` must be the angles recorded last, unless `DiscardErrors` has been
  /// called.
  IkSolution Finish(std::vector<double> angles);

 private:
  void RecordErrors(std::span<const EffectorError> errors, int fk_evaluations);
  void ClearErrors();
  bool MissesByFar(const TreeFrames& frames) const;
  double WorstMeanAxis() const;

  const KinematicTree& tree_;
  const IkProblem& problem_;
  const IkOptions options_;
  const std::vector<AngleRange> ranges_;
  std::vector<double> start_angles_;
  WorstError worst_;
  std::vector<EffectorError> errors_;
  bool has_begun_ = false;
  bool has_stalled_ = false;
  IkSolution solution_;
};

/// Returns the solution that every solver gives for a faulty problem.
IkSolution BadInput(const KinematicTree& tree);

/// Runs a solver that moves from pose to pose. `iterate(run, state, frames)` is called once, after the start has been
/// recorded, and must leave the resulting angles in `state`:
///
///     while (run.MustGoOn()) {
///       … one iteration: new state.angles …
///       if (nothing moved) run.Stall();
///       ComputeFrames(tree, state, frames);
///       run.RecordFrames(frames, state.angles);
///     }
template <class Iterate>
IkSolution RunFromStart(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                        const Iterate& iterate) {
  if (!FindFault(tree, problem, options).empty()) return BadInput(tree);
  IkRun run(tree, problem, options);
  TreeState state = problem.start;
  state.angles = run.start_angles();
  TreeFrames frames = ComputeFrames(tree, state);
  run.RecordFrames(frames, state.angles);
  iterate(run, state, frames);
  return run.Finish(std::move(state.angles));
}

/// Runs a solver that works sweep by sweep and does not need errors itself. A `Sweep` is constructed from (tree,
/// problem, options, own…). `step(sweep, run)` makes one iteration with it and returns the largest turn, radians.
/// After an iteration, the errors of `Sweep::Angles()` are measured only if a trace is requested, if the iteration is
/// the last one, or if `Sweep::MissesGoals()` returns false.
template <class Sweep, class Step, class... Own>
IkSolution RunSweeps(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options, const Step& step,
                     const Own&... own) {
  return RunFromStart(tree, problem, options, [&](IkRun& run, TreeState& state, TreeFrames& frames) {
    Sweep sweep(tree, problem, options, own...);
    while (run.MustGoOn()) {
      const bool has_stalled = step(sweep, run) < options.stall_change;
      const bool is_last = has_stalled || run.iterations() + 1 == options.max_iterations;
      if (run.Traces() || is_last || !sweep.MissesGoals()) {
        state.angles = sweep.Angles();
        ComputeFrames(tree, state, frames);
        run.RecordFrames(frames, state.angles);
      } else {
        run.RecordMisses();
      }
      if (has_stalled) run.Stall();
    }
  });
}

/// The number of restarts of a solver that is stuck.
inline constexpr int kRestarts = 20;

/// Sets `angles` to the pose of restart `number` ≥ 1: every angle differs from `start` by up to 1.5 rad and lies within
/// `ranges`. The pose is a deterministic function of `number` and `start`; it uses no random numbers. Along a motion
/// the start differs from frame to frame, so every frame tries new poses.
void ScatterAround(std::span<const double> start, std::span<const AngleRange> ranges, int number,
                   std::vector<double>& angles);

}  // namespace etude
