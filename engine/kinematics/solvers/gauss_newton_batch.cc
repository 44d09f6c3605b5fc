#include "engine/kinematics/solvers/gauss_newton_batch.h"

#include <algorithm>

#include "engine/kinematics/solvers/gauss_newton_lanes.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/moment_sweep.h"
#include "engine/kinematics/solvers/restarts.h"

namespace etude {
namespace {

constexpr GaussNewtonCourse::Numerics kFloatNumerics{.least_damping = 1e-5, .pulled_above = 1e-6};

class Queue final : public GaussNewtonQueue {
 public:
  Queue(const KinematicTree& tree, const IkBatch& problems, const IkOptions& options, Precision precision,
        const GaussNewtonOptions& own, std::vector<int> asked, IkBatchSolution& solution)
      : tree_(tree),
        problems_(problems),
        options_(options),
        course_(InPrecision(options, precision), own,
                precision == Precision::kFloat ? kFloatNumerics : GaussNewtonCourse::Numerics{}),
        asked_(std::move(asked)),
        may_round_(precision == Precision::kFloat),
        solution_(solution),
        own_ranges_(options.limits && !options.angle_change_tolerance ? 0 : NumberCount(tree)) {}

  int Next() override {
    if (next_ == asked_.size()) return -1;
    const int n = asked_[next_++];
    column_ = problems_.column(n);
    if (own_ranges_.empty()) return n;
    for (std::size_t k = 0; k < own_ranges_.size(); ++k) own_ranges_[k] = column_.numbers[k * column_.stride];
    for (int d = 0; d < tree_.dof_count(); ++d) {
      const AngleRange range = RangeOf(n, d);
      own_ranges_[tree_.dof_count() + d] = range.lower;
      own_ranges_[2 * tree_.dof_count() + d] = range.upper;
    }
    column_ = {own_ranges_.data(), 1};
    return n;
  }

  IkBatch::Column Problem() const override { return column_; }
  GaussNewtonCourse Course() const override { return course_; }

  bool IsOutOfReach(int n) override { return etude::IsOutOfReach(tree_, problems_.Get(n)); }

  bool MeetsGoals(int n, std::span<const double> angles) override {
    return Measure(problems_.Get(n), angles).Within(options_);
  }

  void Sweep(int n, const GaussNewtonCourse::Next& next, GaussNewtonCourse& course, std::span<double> angles) override {
    IkProblem problem = problems_.Get(n);
    problem.limits = AllowedRanges(problem, options_);
    std::vector<double> start = problem.start.angles;
    for (std::size_t d = 0; d < start.size(); ++d) {
      start[d] = std::clamp(start[d], problem.limits[d].lower, problem.limits[d].upper);
    }
    problem.start.angles.assign(angles.begin(), angles.end());
    if (next.restart > 0) ScatterAround(start, problem.limits, next.restart, problem.start.angles);
    MomentSweep sweep(tree_, problem, GaussNewtonSweepOptions(options_));
    for (int i = 0; i < next.sweeps; ++i) {
      sweep.Sweep();
      std::ranges::copy(sweep.Angles(), angles.begin());
      const bool may_go_on = course.CountSweep();
      if (!may_go_on || (!sweep.MissesGoals() && Measure(problem, angles).Within(options_))) break;
    }
  }

  void Finish(int n, const GaussNewtonCourse& course, std::span<const double> angles) override {
    for (int d = 0; d < tree_.dof_count(); ++d) {
      double& angle = solution_.angles[static_cast<std::size_t>(d) * solution_.count + n];
      angle = angles[d];
      if (!may_round_) continue;
      const AngleRange range = own_ranges_.empty() ? LimitsOf(n, d) : RangeOf(n, d);
      angle = std::clamp(angle, range.lower, range.upper);
    }
    solution_.statuses[n] = course.has_converged()                         ? IkStatus::kConverged
                            : etude::IsOutOfReach(tree_, problems_.Get(n)) ? IkStatus::kUnreachable
                            : course.HasStalled()                          ? IkStatus::kStalled
                                                                           : IkStatus::kIterationLimit;
    solution_.iterations[n] = course.iterations();
    solution_.fk_evaluations[n] = course.fk_evaluations();
  }

 private:
  static IkOptions InPrecision(const IkOptions& options, Precision precision) {
    IkOptions made = options;
    if (precision == Precision::kFloat) made.stall_change = std::max(options.stall_change, kFloatStall);
    return made;
  }

  static std::size_t NumberCount(const KinematicTree& tree) {
    return 3 * tree.limits.size() + IkBatch::kRootNumbers + IkBatch::kTargetNumbers * tree.effectors.size();
  }

  AngleRange LimitsOf(int n, int d) const { return {problems_.lower_limits(d)[n], problems_.upper_limits(d)[n]}; }
  AngleRange RangeOf(int n, int d) const {
    return AllowedRange(problems_.start_angles(d)[n], LimitsOf(n, d), options_);
  }

  WorstError Measure(const IkProblem& problem, std::span<const double> angles) {
    TreeState state = problem.start;
    state.angles.assign(angles.begin(), angles.end());
    ComputeFrames(tree_, state, frames_);
    MeasureErrors(frames_, problem.targets, errors_);
    return FindWorst(errors_, problem.targets);
  }

  const KinematicTree& tree_;
  const IkBatch& problems_;
  const IkOptions& options_;
  const GaussNewtonCourse course_;
  const std::vector<int> asked_;
  const bool may_round_;  // angles, to float and beyond their ranges
  std::size_t next_ = 0;
  IkBatchSolution& solution_;
  IkBatch::Column column_;
  std::vector<double> own_ranges_;  // a column whose ranges are not the problem's limits
  TreeFrames frames_;
  std::vector<EffectorError> errors_;
};

}  // namespace

IkBatchSolution SolveGaussNewtonBatch(const KinematicTree& tree, const IkBatch& problems, const IkOptions& options,
                                      Precision precision, const GaussNewtonOptions& own) {
  const std::size_t count = problems.count();
  IkBatchSolution solution;
  solution.count = problems.count();
  solution.angles.resize(tree.limits.size() * count);
  solution.statuses.assign(count, IkStatus::kBadInput);
  solution.iterations.resize(count);
  solution.fk_evaluations.resize(count);
  if (!FindFault(tree, options).empty()) return solution;

  std::vector<int> asked = problems.FindSound();
  const GaussNewtonTree steps_tree(tree);
  const auto solve = [&](std::vector<int> places, Precision in) {
    Queue queue(tree, problems, options, in, own, std::move(places), solution);
    SolveInLanes(steps_tree, GoalsFor(options, in), own.extra_passes, in, queue);
  };
  solve(asked, precision);
  if (precision == Precision::kFloat) {
    std::erase_if(asked, [&](int n) { return solution.statuses[n] == IkStatus::kConverged; });
    if (!asked.empty()) solve(asked, Precision::kDouble);
  }
  return solution;
}

std::vector<IkSolution> SolveGaussNewtonBatch(const KinematicTree& tree, std::span<const IkProblem> problems,
                                              const IkOptions& options, Precision precision,
                                              const GaussNewtonOptions& own) {
  const IkBatchSolution batch = SolveGaussNewtonBatch(tree, IkBatch(tree, problems), options, precision, own);
  std::vector<IkSolution> solutions(problems.size());
  TreeFrames frames;
  for (std::size_t n = 0; n < problems.size(); ++n) {
    IkSolution& solution = solutions[n];
    if (batch.statuses[n] == IkStatus::kBadInput) {
      solution = BadInput(tree);
      continue;
    }
    TreeState state = problems[n].start;
    for (int d = 0; d < tree.dof_count(); ++d) state.angles[d] = batch.angles_of(d)[n];
    ComputeFrames(tree, state, frames);
    MeasureErrors(frames, problems[n].targets, solution.errors);
    solution.status = batch.statuses[n];
    solution.iterations = batch.iterations[n];
    solution.fk_evaluations = batch.fk_evaluations[n];
    solution.angles = std::move(state.angles);
  }
  return solutions;
}

}  // namespace etude
