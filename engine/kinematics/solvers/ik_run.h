#pragma once

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"

namespace etude {

/// Sets `out` to the errors of all effectors at these frames.
void MeasureErrors(const TreeFrames& frames, std::span<const EffectorTarget> targets, std::vector<EffectorError>& out);

/// Sets `out` to the errors of all effectors of `problem` at these angles.
void MeasurePose(const KinematicTree& tree, const IkProblem& problem, std::span<const double> angles,
                 std::vector<EffectorError>& out);

/// Keeps the records of a solver: the ranges of the angles, when to stop, the trace and the status. `tree` and
/// `problem` must be free of faults (`FindFault`) and outlive this. See `RunFromStart` for its use.
class IkRun {
 public:
  IkRun(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

  const std::vector<AngleRange>& ranges() const { return ranges_; }
  /// Returns the problem's start angles, moved into their ranges.
  const std::vector<double>& start_angles() const { return start_angles_; }

  /// Records the start, at the first call, and then the outcome of each iteration: errors by forward kinematics of
  /// `angles`, a list or a function that makes one, which is called for a trace only. `fk_evaluations`: how many
  /// passes led here.
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

  /// Records by the frames of `angles`, for solvers that do not look at errors themselves: errors are computed only
  /// where they are needed, in a trace, near the goals and at the end.
  template <class Angles>
  void RecordFrames(const TreeFrames& frames, const Angles& angles) {
    if (!Traces() && MissesByFar(frames)) {
      RecordMisses();
      return;
    }
    MeasureErrors(frames, problem_.targets, errors_);
    Record(errors_, angles);
  }

  /// Returns whether the trace takes in what is recorded next.
  bool Traces() const { return options_.trace && std::ssize(solution_.trace) < options_.longest_trace; }

  /// Records an iteration that certainly misses the goals and whose errors are not needed: not while it traces.
  void RecordMisses();

  /// Counts a forward-kinematics pass beyond the one of each iteration.
  void CountPass() { ++solution_.fk_evaluations; }
  /// Records that the angles cannot move any further.
  void Stall() { has_stalled_ = true; }

  /// Records that the solution is not the state recorded last, so that its errors take a pass of their own.
  void DiscardErrors();

  bool HasConverged() const { return worst_.Within(options_); }
  bool MustGoOn() const { return !HasConverged() && !has_stalled_ && solution_.iterations < options_.max_iterations; }
  int iterations() const { return solution_.iterations; }

  /// Ends the run. Returns the solution with these angles, which were recorded last.
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

/// Returns what every solver answers to a faulty problem.
IkSolution BadInput(const KinematicTree& tree);

/// Runs a solver that goes from pose to pose. `iterate(run, state, frames)` begins at the start, which is recorded, and
/// leaves the angles that it has found in `state`:
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

/// Runs a solver that goes sweep by sweep and does not look at errors itself. `step(sweep, run)` makes one iteration of
/// a Sweep, made of (tree, problem, options, own…), and returns the largest turn. Errors are measured at
/// `Sweep::Angles` in a trace, and where `Sweep::MissesGoals` does not exclude that the pose meets the goals.
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

/// The number of other poses that a solver that got stuck begins at, before it gives up.
inline constexpr int kRestarts = 20;

/// Sets `angles` to a pose to begin at anew: around `start`, up to 1.5 rad from it in every angle, within `ranges`. It
/// is another one for every number ≥ 1 and every start, and the same at every call: no dice are thrown, and along a
/// motion, with few iterations a frame, every frame tries new ones.
void ScatterAround(std::span<const double> start, std::span<const AngleRange> ranges, int number,
                   std::vector<double>& angles);

}  // namespace etude
