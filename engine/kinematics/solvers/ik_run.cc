#include "engine/kinematics/solvers/ik_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace etude {
namespace {

constexpr double kScatter = 1.5;                     // maximum change of an angle from start to restart, radians
constexpr double kGoldenShare = 0.6180339887498949;  // multiples of this number modulo 1 are evenly distributed
// Each angle of a restart differs from its start angle by a periodic function of that start angle, with this many
// periods per radian. A change by 0.2° covers a whole period, so nearly equal starts get different poses.
constexpr double kSpread = 300;

}  // namespace

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

void IkRun::RecordErrors(std::span<const EffectorError> errors, int fk_evaluations) {
  if (has_begun_) ++solution_.iterations;
  has_begun_ = true;
  solution_.fk_evaluations += fk_evaluations;
  solution_.errors.assign(errors.begin(), errors.end());
  worst_ = FindWorst(errors, problem_.targets);
}

double IkRun::WorstMeanAxis() const {
  double worst = 0;
  for (std::size_t e = 0; e < solution_.errors.size(); ++e) {
    worst = std::max(worst, solution_.errors[e].MeanAxisAngle(problem_.targets[e].axis_weights));
  }
  return worst;
}

// Compares the chord between an axis and its target with the angle goal. A chord is never longer than its angle in
// radians, so if the chord misses the goal, the angle does too.
bool IkRun::MissesByFar(const TreeFrames& frames) const {
  const double squared_position_goal = options_.position_goal * options_.position_goal;
  const double squared_axis_goal = options_.axis_goal * options_.axis_goal;
  for (std::size_t e = 0; e < problem_.targets.size(); ++e) {
    const EffectorTarget& target = problem_.targets[e];
    const LimbFrame& X_WE = frames.effectors[e];
    const glm::dvec3 gap = target.position - X_WE.position;
    if (target.position_weight > 0 && glm::dot(gap, gap) >= squared_position_goal) return true;
    for (int k = 0; k < 3; ++k) {
      if (target.axis_weights[k] <= 0) continue;
      const glm::dvec3 chord = target.axes[k] - X_WE.axes[k];
      if (glm::dot(chord, chord) >= squared_axis_goal) return true;
    }
  }
  return false;
}

void IkRun::RecordMisses() {
  if (has_begun_) ++solution_.iterations;
  has_begun_ = true;
  ++solution_.fk_evaluations;
  ClearErrors();
}

void IkRun::DiscardErrors() {
  ClearErrors();
  ++solution_.fk_evaluations;
}

void IkRun::ClearErrors() {
  solution_.errors.clear();
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  worst_ = {kUnknown, kUnknown};
}

IkSolution IkRun::Finish(std::vector<double> angles) {
  if (solution_.errors.empty()) MeasurePose(tree_, problem_, angles, solution_.errors);
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

void MeasurePose(const KinematicTree& tree, const IkProblem& problem, std::span<const double> angles,
                 std::vector<EffectorError>& out) {
  const TreeState state{problem.start.root_position, problem.start.root_frame, {angles.begin(), angles.end()}};
  MeasureErrors(ComputeFrames(tree, state), problem.targets, out);
}

void ScatterAround(std::span<const double> start, std::span<const AngleRange> ranges, int number,
                   std::vector<double>& angles) {
  angles.resize(start.size());
  for (std::size_t d = 0; d < start.size(); ++d) {
    double x = kGoldenShare * number * (static_cast<double>(d) + 1) + kSpread * start[d];
    x -= std::floor(x);
    angles[d] = std::clamp(start[d] + kScatter * (2 * x - 1), ranges[d].lower, ranges[d].upper);
  }
}

}  // namespace etude
