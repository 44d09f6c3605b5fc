#include "engine/kinematics/solvers/ik_run.h"

namespace etude {

IkRun::IkRun(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options)
    : tree_(tree),
      problem_(problem),
      options_(options),
      ranges_(AllowedRanges(problem, options)),
      start_angles_(problem.start.angles) {
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    start_angles_[i] = std::clamp(start_angles_[i], ranges_[i].lower, ranges_[i].upper);
  }
}

void IkRun::Book(std::span<const EffectorError> errors, int fk_evaluations) {
  if (has_begun_) ++solution_.iterations;
  has_begun_ = true;
  solution_.fk_evaluations += fk_evaluations;
  solution_.errors.assign(errors.begin(), errors.end());
  worst_ = FindWorst(errors, problem_.targets);
}

IkSolution IkRun::Finish(std::vector<double> angles) {
  solution_.status = HasConverged()                  ? IkStatus::kConverged
                     : IsOutOfReach(tree_, problem_) ? IkStatus::kUnreachable
                     : has_stalled_                  ? IkStatus::kStalled
                                                     : IkStatus::kIterationLimit;
  solution_.angles = std::move(angles);
  return std::move(solution_);
}

IkSolution BadInput(const KinematicTree& tree) {
  IkSolution solution;
  solution.status = IkStatus::kBadInput;
  solution.angles.assign(tree.limits.size(), 0.0);
  return solution;
}

void MeasureErrors(const TreeFrames& frames, std::span<const EffectorTarget> targets, std::vector<EffectorError>& out) {
  out.resize(targets.size());
  for (std::size_t e = 0; e < targets.size(); ++e) out[e] = ErrorOf(frames.effectors[e], targets[e]);
}

}  // namespace etude
