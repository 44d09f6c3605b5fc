#include "engine/kinematics/solvers/moment_sweep.h"

#include <cmath>

#include "engine/kinematics/solvers/sweep_kernel-inl.h"

namespace etude {

namespace lanes = HWY_NAMESPACE;  // of the narrowest target: one double is one lane

struct MomentSweep::State {
  State(const KinematicTree& body, const IkProblem& asked, const IkOptions& options)
      : formula(FormulaOf(options.weights)),
        squared_position_goal(options.position_goal * options.position_goal),
        squared_axis_goal(options.axis_goal * options.axis_goal),
        tree(body),
        problem(tree, asked, AllowedRanges(asked, options)),
        sweep(tree, body.dof_count()) {
    lanes::LoadProblem(problem, 0, sweep);
  }

  const WeightFormula formula;
  const double squared_position_goal, squared_axis_goal;
  const SweepTree tree;
  const SweepProblem problem;
  lanes::SweepState<double> sweep;
};

bool MomentSweep::CanServe(const IkOptions& options) {
  const bool same_at_every_joint = options.refresh == WeightRefresh::kSweep || !IsAdaptive(options.weights);
  return same_at_every_joint && options.weights != WeightRule::kWangChen;
}

MomentSweep::MomentSweep(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options)
    : state_(std::make_unique<State>(tree, problem, options)) {
  Measure();
}

MomentSweep::~MomentSweep() = default;

double MomentSweep::Sweep() {
  const double change = Turn();
  Measure();
  return change;
}

double MomentSweep::Turn() { return std::sqrt(lanes::SweepHinges(state_->tree, state_->formula, state_->sweep)); }

void MomentSweep::Measure() { lanes::PlaceLimbs(state_->tree, state_->sweep); }

double MomentSweep::Merit() const {
  double merit = 0;
  for (const lanes::GoalOf<double>& goal : state_->sweep.goals) {
    merit += goal.position_pull * goal.squared_distance;
    for (int k = 0; k < 3; ++k) merit += goal.axis_pulls[k] * goal.squared_chords[k];
  }
  return merit;
}

void MomentSweep::ReadHalfTangents(std::span<double> out) const {
  for (std::size_t i = 0; i < out.size(); ++i) {
    const lanes::HingeOf<double>& hinge = state_->sweep.hinges[i];
    const double c = hinge.c * hinge.cos_middle + hinge.s * hinge.sin_middle;
    const double s = hinge.s * hinge.cos_middle - hinge.c * hinge.sin_middle;
    out[i] = c >= 0 ? s / (1 + c) : (1 - c) / s;  // the same, each where it keeps its digits
  }
}

void MomentSweep::SetHalfTangents(std::span<const double> half_tangents) {
  for (std::size_t i = 0; i < half_tangents.size(); ++i) {
    lanes::HingeOf<double>& hinge = state_->sweep.hinges[i];
    const double t = half_tangents[i], scale = 1 / (1 + t * t);
    const double free_c = (1 - t * t) * scale, free_s = 2 * t * scale;  // from the middle, without limits
    const bool is_inside = free_c >= hinge.cos_half;
    const double c = is_inside ? free_c : hinge.cos_half;
    const double s = is_inside ? free_s : std::copysign(hinge.sin_half, t);
    hinge.c = c * hinge.cos_middle - s * hinge.sin_middle;
    hinge.s = s * hinge.cos_middle + c * hinge.sin_middle;
  }
}

bool MomentSweep::MissesGoals() const {
  return lanes::MissesGoals(state_->squared_position_goal, state_->squared_axis_goal, state_->sweep);
}

std::vector<double> MomentSweep::Angles() const {
  std::vector<double> angles;
  for (std::size_t i = 0; i < state_->sweep.hinges.size(); ++i) {
    const lanes::HingeOf<double>& hinge = state_->sweep.hinges[i];
    angles.push_back(state_->problem.Angle(static_cast<int>(i), hinge.c, hinge.s));
  }
  return angles;
}

std::vector<EffectorError> MomentSweep::errors() const {
  std::vector<EffectorError> errors;
  for (std::size_t e = 0; e < state_->sweep.goals.size(); ++e) {
    const lanes::GoalOf<double>& goal = state_->sweep.goals[e];
    const int(&names)[3] = state_->tree.effectors[e].names;
    EffectorError& error = errors.emplace_back();
    error.position = std::sqrt(goal.squared_distance);
    for (int k = 0; k < 3; ++k) error.axis_angles[names[k]] = lanes::AngleOfChord(goal.squared_chords[k]);
  }
  return errors;
}

}  // namespace etude
