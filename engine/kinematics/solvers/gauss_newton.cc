#include "engine/kinematics/solvers/gauss_newton.h"

#include <algorithm>
#include <utility>

#include "engine/kinematics/solvers/gauss_newton_limbs.h"
#include "engine/kinematics/solvers/gauss_newton_plain.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/limb_packs.h"
#include "engine/kinematics/solvers/linear_targets.h"
#include "engine/kinematics/solvers/moment_sweep.h"
#include "engine/kinematics/solvers/restarts.h"

namespace etude {

class GaussNewtonSolver::Solver final : public GaussNewtonHelp {
 public:
  explicit Solver(const KinematicTree& tree) : tree_(tree), packs_(tree), limbs_(GaussNewtonLimbs::Make(packs_)) {}

  IkSolution Solve(const IkProblem& problem, const IkOptions& options, const GaussNewtonOptions& own) {
    problem_ = &problem;
    options_ = &options;
    Take();
    GaussNewtonCourse course(options, own, {});
    limbs_->Solve(GoalsFor(options, Precision::kDouble), own.extra_passes, course, *this);
    IkSolution solution;
    solution.angles = ToAngles(limbs_->angles);
    if (course.has_converged()) {
      MeasureEnds(solution.errors);
    } else {
      MeasurePose(solution.angles, solution.errors);
    }
    solution.status = course.has_converged() ? IkStatus::kConverged
                      : IsOutOfReach()       ? IkStatus::kUnreachable
                      : course.HasStalled()  ? IkStatus::kStalled
                                             : IkStatus::kIterationLimit;
    solution.iterations = course.iterations();
    solution.fk_evaluations = course.fk_evaluations();
    return solution;
  }

 private:
  bool IsOutOfReach() override { return etude::IsOutOfReach(tree_, *problem_); }

  bool MeetsGoals(std::span<const double> angles) override {
    std::vector<EffectorError> errors;
    MeasurePose(ToAngles(angles.data()), errors);
    return FindWorst(errors, problem_->targets).Within(*options_);
  }

  void Sweep(const GaussNewtonCourse::Next& next, GaussNewtonCourse& course, std::span<double> angles) override {
    IkProblem problem = *problem_;
    problem.limits = AllowedRanges(*problem_, *options_);
    for (std::size_t d = 0; d < problem.limits.size(); ++d) {
      double& start = problem.start.angles[d];
      start = std::clamp(start, problem.limits[d].lower, problem.limits[d].upper);
    }
    if (next.restart > 0) {
      ScatterAround(std::vector<double>(problem.start.angles), problem.limits, next.restart, problem.start.angles);
    } else {
      problem.start.angles = ToAngles(angles.data());
    }
    MomentSweep sweep(tree_, problem, GaussNewtonSweepOptions(*options_));
    for (int i = 0; i < next.sweeps; ++i) {
      sweep.Sweep();
      Put(sweep.Angles(), angles.data());
      if (!course.CountSweep() || (!sweep.MissesGoals() && MeetsGoals(angles))) break;
    }
  }

  void Take() {
    for (std::size_t d = 0; d < packs_.places.size(); ++d) {
      const double start = problem_->start.angles[d];
      const AngleRange range = AllowedRange(start, problem_->limits[d], *options_);
      const int place = packs_.places[d];
      limbs_->angles[place] = std::clamp(start, range.lower, range.upper);
      limbs_->lower[place] = range.lower;
      limbs_->upper[place] = range.upper;
    }
    for (int k = 0; k < 3; ++k) {
      limbs_->root[k] = problem_->start.root_position[k];
      for (int c = 0; c < 3; ++c) limbs_->root[3 + 3 * c + k] = problem_->start.root_frame[c][k];
    }
    for (std::size_t e = 0; e < problem_->targets.size(); ++e) {
      const EffectorTarget& target = problem_->targets[e];
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

  std::vector<double> ToAngles(const double* at_places) const {
    std::vector<double> angles(packs_.places.size());
    for (std::size_t d = 0; d < angles.size(); ++d) angles[d] = at_places[packs_.places[d]];
    return angles;
  }
  void Put(std::span<const double> angles, double* at_places) const {
    for (std::size_t d = 0; d < angles.size(); ++d) at_places[packs_.places[d]] = angles[d];
  }

  void MeasureEnds(std::vector<EffectorError>& errors) const {
    errors.resize(problem_->targets.size());
    for (std::size_t e = 0; e < errors.size(); ++e) {
      const auto [p, axes] = limbs_->EndOf(static_cast<int>(e));
      LimbFrame X_WE;
      X_WE.position = {p[0], p[1], p[2]};
      for (int c = 0; c < 3; ++c) X_WE.axes[c] = {axes[c][0], axes[c][1], axes[c][2]};
      errors[e] = ErrorOf(X_WE, problem_->targets[e]);
    }
  }
  void MeasurePose(const std::vector<double>& angles, std::vector<EffectorError>& errors) {
    TreeState state = problem_->start;
    state.angles = angles;
    ComputeFrames(tree_, state, frames_);
    MeasureErrors(frames_, problem_->targets, errors);
  }

  const KinematicTree& tree_;
  const LimbPacks packs_;
  const std::unique_ptr<GaussNewtonLimbs> limbs_;
  const IkProblem* problem_ = nullptr;
  const IkOptions* options_ = nullptr;
  TreeFrames frames_;
};

GaussNewtonSolver::GaussNewtonSolver(const KinematicTree& tree) : tree_(tree) {
  if (FindTreeFault(tree).empty()) solver_ = std::make_unique<Solver>(tree);
}
GaussNewtonSolver::~GaussNewtonSolver() = default;

IkSolution GaussNewtonSolver::Solve(const IkProblem& problem, const IkOptions& options,
                                    const GaussNewtonOptions& own) const {
  if (!solver_ || !FindFault(options).empty() || !FindProblemFault(tree_, problem).empty()) return BadInput(tree_);
  return options.trace ? SolveGaussNewtonPlainly(tree_, problem, options, own) : solver_->Solve(problem, options, own);
}

IkOptions GaussNewtonSweepOptions(const IkOptions& options) {
  IkOptions made = options;
  made.weights = WeightRule::kAdaptivePower;
  made.refresh = WeightRefresh::kSweep;
  made.limits = true;
  made.angle_change_tolerance.reset();
  return made;
}

IkSolution SolveGaussNewton(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                            const GaussNewtonOptions& own) {
  return GaussNewtonSolver(tree).Solve(problem, options, own);
}

}  // namespace etude
