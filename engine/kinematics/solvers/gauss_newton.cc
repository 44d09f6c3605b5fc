#include "engine/kinematics/solvers/gauss_newton.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "engine/kinematics/sine_cosine.h"
#include "engine/kinematics/solvers/gauss_newton_vectors.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/linear_targets.h"
#include "engine/kinematics/solvers/moment_sweep.h"
#include "hwy/highway.h"

namespace etude {
namespace {

// If an error differs from its goal by less than this share of the goal plus this absolute amount, rounding could
// decide the comparison, so the error is measured exactly.
constexpr double kDoubtfulShare = 1e-9, kDoubtfulRounding = 1e-14;

// The float solver aims at this share of each goal, so that float's rounding cannot make a missed goal look reached.
constexpr double kFloatShare = 0.9;
// Stall threshold in float, radians: an angle may move by its last bit after the pose has converged.
constexpr double kFloatStall = 2e-7;
constexpr GaussNewtonCourse::Numerics kFloatNumerics{.min_damping = 1e-5, .pulled_above = 1e-6};

double SquareBelow(double goal) {
  const double certain = std::max(0.0, goal * (1 - kDoubtfulShare) - kDoubtfulRounding);
  return certain * certain;
}

// Scalar code for the rare operations of the vector solvers.
class ScalarHelp final : public GaussNewtonHelp {
 public:
  using FindProblem = std::function<IkProblem(int)>;

  ScalarHelp(const KinematicTree& tree, const IkOptions& options, FindProblem find)
      : tree_(tree), options_(options), find_(std::move(find)) {}

  bool IsOutOfReach(int n) override { return etude::IsOutOfReach(tree_, find_(n)); }

  bool MeetsGoals(int n, std::span<const double> angles) override { return MeetsGoalsOf(find_(n), angles); }

  void Sweep(int n, const GaussNewtonCourse::Next& next, GaussNewtonCourse& course, std::span<double> angles) override {
    // Start within the allowed ranges: at the given angles, or at the pose of the restart.
    IkProblem problem = find_(n);
    problem.limits = AllowedRanges(problem, options_);
    std::vector<double> start = problem.start.angles;
    for (std::size_t d = 0; d < start.size(); ++d) {
      start[d] = std::clamp(start[d], problem.limits[d].lower, problem.limits[d].upper);
    }
    problem.start.angles.assign(angles.begin(), angles.end());
    if (next.restart > 0) ScatterAround(start, problem.limits, next.restart, problem.start.angles);
    // Sweep until the goals are met or no iterations are left.
    MomentSweep sweep(tree_, problem, GaussNewtonSweepOptions(options_));
    for (int i = 0; i < next.sweeps; ++i) {
      sweep.Sweep();
      std::ranges::copy(sweep.Angles(), angles.begin());
      if (run_ != nullptr) Record(angles);
      const bool may_go_on = course.CountSweep();
      if (!may_go_on || (!sweep.MissesGoals() && MeetsGoalsOf(problem, angles))) break;
    }
  }

  /// Makes `run` record the start pose and every later pose; only for one problem. `run` must outlive this object.
  void RecordIn(IkRun& run) {
    run_ = &run;
    Record(run.start_angles());
  }

  void Record(std::span<const double> angles) override {
    TreeState state = find_(0).start;
    state.angles.assign(angles.begin(), angles.end());
    run_->RecordFrames(ComputeFrames(tree_, state), state.angles);
  }

  IkStatus StatusOf(int n, const GaussNewtonCourse& course) {
    return course.has_converged() ? IkStatus::kConverged
           : IsOutOfReach(n)      ? IkStatus::kUnreachable
           : course.HasStalled()  ? IkStatus::kStalled
                                  : IkStatus::kIterationLimit;
  }

 private:
  bool MeetsGoalsOf(const IkProblem& problem, std::span<const double> angles) const {
    std::vector<EffectorError> errors;
    MeasurePose(tree_, problem, angles, errors);
    return FindWorst(errors, problem.targets).Within(options_);
  }

  const KinematicTree& tree_;
  const IkOptions& options_;
  const FindProblem find_;
  IkRun* run_ = nullptr;
};

// Hands out the problems of a batch and stores their solutions.
class BatchQueue final : public GaussNewtonQueue {
 public:
  BatchQueue(const KinematicTree& tree, const IkBatch& problems, const IkOptions& options, Precision precision,
             const GaussNewtonOptions& own, std::vector<int> asked, ScalarHelp& help, IkBatchSolution& solution)
      : tree_(tree),
        problems_(problems),
        options_(options),
        course_(InPrecision(options, precision), own,
                precision == Precision::kFloat ? kFloatNumerics : GaussNewtonCourse::Numerics{}),
        asked_(std::move(asked)),
        rounds_angles_(precision == Precision::kFloat),
        help_(help),
        solution_(solution),
        own_ranges_(options.limits && !options.angle_change_tolerance ? 0 : NumberCount(tree)) {}

  int Next() override {
    if (next_ == asked_.size()) return -1;
    const int n = asked_[next_++];
    const IkBatch::Column from = problems_.column(n);
    column_ = {from.numbers, from.stride};
    if (own_ranges_.empty()) return n;
    for (std::size_t k = 0; k < own_ranges_.size(); ++k) own_ranges_[k] = from.numbers[k * from.stride];
    for (int d = 0; d < tree_.dof_count(); ++d) {
      const AngleRange range = RangeOf(n, d);
      own_ranges_[tree_.dof_count() + d] = range.lower;
      own_ranges_[2 * tree_.dof_count() + d] = range.upper;
    }
    column_ = {own_ranges_.data(), 1};
    return n;
  }

  Column Problem() const override { return column_; }
  GaussNewtonCourse Course() const override { return course_; }

  void Finish(int n, const GaussNewtonCourse& course, std::span<const double> angles) override {
    for (int d = 0; d < tree_.dof_count(); ++d) {
      double& angle = solution_.angles[static_cast<std::size_t>(d) * solution_.count + n];
      angle = angles[d];
      if (!rounds_angles_) continue;
      const AngleRange range = own_ranges_.empty() ? LimitsOf(n, d) : RangeOf(n, d);
      angle = std::clamp(angle, range.lower, range.upper);
    }
    solution_.statuses[n] = help_.StatusOf(n, course);
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

  const KinematicTree& tree_;
  const IkBatch& problems_;
  const IkOptions& options_;
  const GaussNewtonCourse course_;
  const std::vector<int> asked_;
  const bool rounds_angles_;  // true in float, where rounded angles may leave their ranges
  std::size_t next_ = 0;
  ScalarHelp& help_;
  IkBatchSolution& solution_;
  Column column_;
  // The numbers of the current problem, with the allowed ranges in place of the limits; empty if ranges and limits are
  // equal.
  std::vector<double> own_ranges_;
};

}  // namespace

GaussNewtonRules RulesFor(const IkOptions& options, const GaussNewtonOptions& own, Precision precision) {
  const double position = options.position_goal, axis = options.axis_goal;
  // An axis error is compared as a chord of the unit circle, which is shorter than the angle.
  const double chord = 2 * ComputeSineCosine(0.5 * std::min(axis, kPi)).sine;
  if (precision == Precision::kDouble) {
    return {SquareBelow(position), position * position, SquareBelow(chord),
            axis * axis,           own.extra_passes,    kMaxTurn};
  }
  constexpr double kSquaredShare = kFloatShare * kFloatShare;
  const double squared_distance = kSquaredShare * position * position, squared_chord = kSquaredShare * chord * chord;
  return {squared_distance, squared_distance, squared_chord, squared_chord, own.extra_passes, kMaxTurn};
}

GaussNewtonCourse::GaussNewtonCourse(const IkOptions& options, const GaussNewtonOptions& own, const Numerics& numerics)
    : numerics_(numerics),
      max_iterations_(options.max_iterations),
      first_sweeps_(own.first_sweeps),
      patience_(std::clamp(options.max_iterations / kShareOfPatience, 1, kPatience)),
      stall_change_(options.stall_change),
      max_restarts_(own.restarts) {
  static_assert(GaussNewtonOptions{}.restarts == kRestarts);
  Begin(Phase::kToStart, kProgress, patience_);
}

// Copies one problem into the layout of `GaussNewtonLimbs`, and copies the solution back.
class GaussNewtonSolver::Solver {
 public:
  explicit Solver(const KinematicTree& tree) : tree_(tree), packs_(tree), limbs_(GaussNewtonLimbs::Make(packs_)) {}

  IkSolution Solve(const IkProblem& problem, const IkOptions& options, const GaussNewtonOptions& own) {
    ScalarHelp help(tree_, options, [&problem](int) { return problem; });
    GaussNewtonRules rules = RulesFor(options, own, Precision::kDouble);
    std::optional<IkRun> traced;
    if (options.trace) {
      help.RecordIn(traced.emplace(tree_, problem, options));
      rules.traces = true;
    }
    PutAngles(problem, options);
    PutTargets(problem);
    GaussNewtonCourse course(options, own, {});
    limbs_->Solve(rules, course, help);
    IkSolution solution;
    solution.angles.resize(packs_.places.size());
    for (std::size_t d = 0; d < packs_.places.size(); ++d) solution.angles[d] = limbs_->angles[packs_.places[d]];
    if (course.has_converged()) {
      MeasureEnds(problem, solution.errors);
    } else {
      MeasurePose(tree_, problem, solution.angles, solution.errors);
    }
    solution.status = help.StatusOf(0, course);
    solution.iterations = course.iterations();
    solution.fk_evaluations = course.fk_evaluations();
    if (traced) solution.trace = traced->Finish(solution.angles).trace;
    return solution;
  }

 private:
  void PutAngles(const IkProblem& problem, const IkOptions& options) {
    for (std::size_t d = 0; d < packs_.places.size(); ++d) {
      const double start = problem.start.angles[d];
      const AngleRange range = AllowedRange(start, problem.limits[d], options);
      const int place = packs_.places[d];
      limbs_->angles[place] = std::clamp(start, range.lower, range.upper);
      limbs_->lower[place] = range.lower;
      limbs_->upper[place] = range.upper;
    }
    for (int k = 0; k < 3; ++k) {
      limbs_->root[k] = problem.start.root_position[k];
      for (int c = 0; c < 3; ++c) limbs_->root[3 + 3 * c + k] = problem.start.root_frame[c][k];
    }
  }

  void PutTargets(const IkProblem& problem) {
    for (std::size_t e = 0; e < problem.targets.size(); ++e) {
      const EffectorTarget& target = problem.targets[e];
      double* to = limbs_->TargetOf(static_cast<int>(e));
      const auto put = [&to](double x) {
        *to = x;
        to += LimbPacks::kWidth;
      };
      for (int k = 0; k < 3; ++k) put(target.position[k]);
      for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < 3; ++k) put(target.axes[c][k]);
      }
      put(target.position_weight / (kPositionScale * kPositionScale));
      for (int k = 0; k < 3; ++k) put(target.axis_weights[k]);
    }
  }

  void MeasureEnds(const IkProblem& problem, std::vector<EffectorError>& errors) const {
    errors.resize(problem.targets.size());
    for (std::size_t e = 0; e < errors.size(); ++e) {
      const auto [p, axes] = limbs_->EndOf(static_cast<int>(e));
      LimbFrame X_WE;
      X_WE.position = {p[0], p[1], p[2]};
      for (int c = 0; c < 3; ++c) X_WE.axes[c] = {axes[c][0], axes[c][1], axes[c][2]};
      errors[e] = ErrorOf(X_WE, problem.targets[e]);
    }
  }

  const KinematicTree& tree_;
  const LimbPacks packs_;
  const std::unique_ptr<GaussNewtonLimbs> limbs_;
};

GaussNewtonSolver::GaussNewtonSolver(const KinematicTree& tree) : tree_(tree) {
  if (FindTreeFault(tree).empty()) solver_ = std::make_unique<Solver>(tree);
}
GaussNewtonSolver::~GaussNewtonSolver() = default;

IkSolution GaussNewtonSolver::Solve(const IkProblem& problem, const IkOptions& options,
                                    const GaussNewtonOptions& own) const {
  if (!solver_ || !FindFault(options).empty() || !FindProblemFault(tree_, problem).empty()) return BadInput(tree_);
  return solver_->Solve(problem, options, own);
}

IkSolution SolveGaussNewton(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                            const GaussNewtonOptions& own) {
  return GaussNewtonSolver(tree).Solve(problem, options, own);
}

IkBatchSolution SolveGaussNewtonBatch(const KinematicTree& tree, const IkBatch& problems, const IkOptions& options,
                                      Precision precision, const GaussNewtonOptions& own) {
  // Set the status of every problem to kBadInput until it is solved.
  const std::size_t count = problems.count();
  IkBatchSolution solution;
  solution.count = problems.count();
  solution.angles.resize(tree.limits.size() * count);
  solution.statuses.assign(count, IkStatus::kBadInput);
  solution.iterations.resize(count);
  solution.fk_evaluations.resize(count);
  if (!FindFault(tree, options).empty()) return solution;

  // Solve all problems without faults. Problems that float did not solve are solved again in double.
  std::vector<int> asked = problems.FindSound();
  const GaussNewtonTree lane_tree(tree);
  ScalarHelp help(tree, options, [&problems](int n) { return problems.Get(n); });
  const auto solve = [&](std::vector<int> places, Precision in) {
    BatchQueue queue(tree, problems, options, in, own, std::move(places), help, solution);
    const auto solve_in = in == Precision::kFloat ? SolveInFloats : SolveInDoubles;
    solve_in(lane_tree, RulesFor(options, own, in), queue, help);
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
  // Compute the errors of every solution from its angles.
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

IkOptions GaussNewtonSweepOptions(const IkOptions& options) {
  IkOptions made = options;
  made.weights = WeightRule::kAdaptivePower;
  made.refresh = WeightRefresh::kSweep;
  made.limits = true;
  made.angle_change_tolerance.reset();
  return made;
}

std::vector<std::string> BatchTargets() {
  hwy::SetSupportedTargetsForTest(0);
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) names.push_back(hwy::TargetName(target));
  return names;
}

void SetBatchTarget(std::string_view name) {
  hwy::SetSupportedTargetsForTest(0);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    if (name == hwy::TargetName(target)) hwy::SetSupportedTargetsForTest(target);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace etude
