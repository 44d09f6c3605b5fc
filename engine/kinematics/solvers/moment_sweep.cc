// The sums that a hinge needs over all end effectors beyond the hinge are passed from joint to joint as one 4×4 matrix,
// so the cost does not depend on the number of effectors. Angles are stored as (cos, sin), so the loop needs no
// trigonometric functions.
//
// For every effector E beyond a joint and its target D, the moments are
//     M = Σ w_p (p_LE, 1)(p_WD, 1)ᵀ + Σ_k w_ok (u_kE_L, 0)(u_kD_W, 0)ᵀ,
// with rows in the frame of the limb L and columns in the world W, whose origin is at the root here. A hinge that turns
// axis i of L towards axis j by the angle q has the gain
//     x cos q + y sin q,   x = M_i·ê_i + M_j·ê_j,   y = M_i·ê_j − M_j·ê_i,
// where M_i is a row, and ê = (e_W, −p_WJ·e_W) describes an axis e of the frame before the hinge turns: M_i·ê_j sums
// the current components along i times the desired components along j, all relative to the joint J. So the best angle
// has the direction (x, y) (paper B's equations 3.10–3.13 for several effectors). The turn by the best angle rotates
// the pair of rows i and j. To refer the moments to the parent's joint, p_PJ[r] times the last row is added to row r.
// Columns never change. The vectors ê are also enough for forward kinematics: a turn rotates a pair of them, and a
// step by p_PJ subtracts p_PJ[k] from the last component of ê_k.
#include "engine/kinematics/solvers/moment_sweep.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/kinematics/solvers/quad-inl.h"
#include "engine/kinematics/solvers/sweep_tree.h"

namespace etude {
namespace {

// ---- State of a sweep ----------------------------------------------------------------------------------------------

struct HingeState {
  double c, s;  // cosine and sine of the angle
  // Cosine and sine of the middle of the angle's range and of half its width; `cos_half` is −2 if the angle is
  // unlimited.
  double cos_middle, sin_middle, cos_half, sin_half;
};

struct Moments {
  Quad rows[4];
};

struct GoalState {
  Quad axes[3];   // axes of the target, (u_kD_W, 0)
  Quad position;  // position of the target relative to the root, (p_RD_W, 1)
  double position_weight, axis_weights[3];
  double position_share, axis_shares[3];  // 1 if the position or axis has weight, else 0
  // Errors at the pose measured last, and weights of the present sweep.
  double squared_distance, squared_chords[3];
  double position_pull, axis_pulls[3];
};

// Returns the zero point from which an angle is counted: the middle of its range, or its start if the angle is free.
double MiddleOf(const AngleRange& range, double start) {
  const bool is_free = start - kPi > range.lower && start + kPi < range.upper;
  return is_free ? start : 0.5 * (range.lower + range.upper);
}

HingeState HingeAt(double start, const AngleRange& range, double middle) {
  const double angle = std::clamp(start, range.lower, range.upper);
  const double half = 0.5 * (range.upper - range.lower);
  const bool is_bounded = half < kPi;
  return {std::cos(angle),
          std::sin(angle),
          std::cos(middle),
          std::sin(middle),
          is_bounded ? std::cos(half) : -2,
          is_bounded ? std::sin(half) : 0};
}

GoalState GoalAt(const SweepTree::Effector& effector, const EffectorTarget& target, const glm::dvec3& root) {
  const glm::dvec3 p_RD_W = target.position - root;
  GoalState goal{};
  goal.position = MakeQuad({p_RD_W.x, p_RD_W.y, p_RD_W.z}, 1);
  goal.position_weight = target.position_weight;
  goal.position_share = target.position_weight > 0 ? 1 : 0;
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3 axis = effector.signs[k] * target.axes[effector.names[k]];
    goal.axes[k] = MakeQuad({axis.x, axis.y, axis.z}, 0);
    goal.axis_weights[k] = target.axis_weights[effector.names[k]];
    goal.axis_shares[k] = goal.axis_weights[k] > 0 ? 1 : 0;
  }
  return goal;
}

// ---- Parts of a sweep ----------------------------------------------------------------------------------------------

// Turns a hinge to the best angle within its range, and transforms the two rows of moments accordingly. Returns the
// squared chord of the turn, which equals the squared turn for small turns.
HWY_INLINE double TurnHinge(const Quad& from, const Quad& towards, HingeState& hinge, Quad& row_i, Quad& row_j) {
  // The unlimited optimum has the direction (x, y).
  const Quad a = row_i, b = row_j;
  const double x = Sum(a * from + b * towards);
  const double y = Sum(a * towards - b * from);
  const double square = x * x + y * y;
  const double length = std::sqrt(square);
  // If the optimum is outside the range, take the end that is nearer on the circle, because it has the larger gain; on
  // a tie, take the lower end. The test uses (x, y) without dividing it by its length, so that the test need not wait
  // for the division.
  const bool is_inside = x * hinge.cos_middle + y * hinge.sin_middle >= hinge.cos_half * length;
  const bool is_below = 0.0 >= y * hinge.cos_middle - x * hinge.sin_middle;
  const double half_s = is_below ? 0.0 - hinge.sin_half : hinge.sin_half;
  const double end_c = hinge.cos_middle * hinge.cos_half - hinge.sin_middle * half_s;
  const double end_s = hinge.sin_middle * hinge.cos_half + hinge.cos_middle * half_s;
  const bool is_flat = 0.0 >= square;  // the gain is constant: keep the angle
  const double scale = 1.0 / (is_flat ? 1.0 : length);
  const double old_c = hinge.c, old_s = hinge.s;
  const double c = is_flat ? old_c : is_inside ? x * scale : end_c;
  const double s = is_flat ? old_s : is_inside ? y * scale : end_s;
  // Store the angle, and turn rows i and j of the moments by it.
  hinge.c = c;
  hinge.s = s;
  row_i = a * c - b * s;
  row_j = b * c + a * s;
  const double dc = c - old_c, ds = s - old_s;
  return dc * dc + ds * ds;
}

// Adds an effector's moments to the moments of its limb. The limb's first effector sets the limb's moments instead.
void AddEffector(const SweepTree::Effector& effector, const GoalState& goal, Moments& moments) {
  const Quad pull = goal.position * goal.position_pull;
  const auto add = [&](const Quad& row, Quad& sum) { sum = effector.is_first ? row : sum + row; };
  for (int r = 0; r < 3; ++r) add(goal.axes[r] * goal.axis_pulls[r] + pull * effector.p_LE[r], moments.rows[r]);
  add(pull, moments.rows[3]);
}

// Transforms the moments of a limb, whose hinges have turned, to its parent's joint and frame, and adds them to the
// parent's moments. The first child shares its memory with the parent, so nothing is added.
void PassToParent(const SweepTree::Joint& joint, Moments& child, Moments& parent) {
  if (!joint.is_aligned) {
    const double(&R_PJ)[3][3] = joint.R_PJ;
    const Quad x = child.rows[0], y = child.rows[1], z = child.rows[2];
    for (int r = 0; r < 3; ++r) child.rows[r] = Mix(x, R_PJ[r][0], y, R_PJ[r][1], z, R_PJ[r][2]);
  }
  const Quad last = child.rows[3];
  for (int r = 0; r < 3; ++r) {
    if (joint.p_PJ[r] != 0) child.rows[r] = child.rows[r] + last * joint.p_PJ[r];
  }
  if (joint.is_first) return;
  for (int r = 0; r < 4; ++r) parent.rows[r] = parent.rows[r] + child.rows[r];
}

// Returns the angle of a chord of the unit circle, 2 asin(√chord² / 2), with a relative error of 10⁻¹². Up to a right
// angle it uses a minimax polynomial in (chord / 2)² (ours); beyond, it uses the chord of the supplementary angle.
double AngleOfChord(double squared_chord) {
  constexpr double kTerms[] = {2.0000000000021307,   0.3333333319413167,  0.15000015042731862,  0.08927934444224939,
                               0.060903478193634814, 0.04293404585618574, 0.049655906059604696, -0.05387645705990194,
                               0.3244398378475416,   -0.7231340774880451, 1.199828495946593,    -1.102007953973178,
                               0.5043726115326342};
  const double whole = squared_chord * 0.25;
  const bool is_small = 0.5 >= whole;
  // Rounding can make the squared chord exceed 4.
  const double rest = 1.0 >= whole ? 1.0 - whole : 0.0;
  const double z = is_small ? whole : rest;
  double sum = kTerms[std::size(kTerms) - 1];
  for (int k = static_cast<int>(std::size(kTerms)) - 2; k >= 0; --k) sum = sum * z + kTerms[k];
  const double angle = std::sqrt(z) * sum;
  return is_small ? angle : 3.141592653589793 - angle;
}

double PowerOf(double x, ErrorPower power) {
  return power == ErrorPower::kThreeQuarters ? std::sqrt(x * std::sqrt(x)) : x;
}

}  // namespace

struct MomentSweep::State {
  State(const KinematicTree& body, const IkProblem& problem, const IkOptions& options)
      : formula(FormulaOf(options.weights)),
        squared_position_goal(options.position_goal * options.position_goal),
        squared_axis_goal(options.axis_goal * options.axis_goal),
        tree(body),
        ranges(AllowedRanges(problem, options)),
        axes(tree.axis_count),
        moments(tree.moments_count) {
    for (std::size_t d = 0; d < ranges.size(); ++d) {
      middles.push_back(MiddleOf(ranges[d], problem.start.angles[d]));
      hinges.push_back(HingeAt(problem.start.angles[d], ranges[d], middles[d]));
    }
    for (std::size_t e = 0; e < problem.targets.size(); ++e) {
      goals.push_back(GoalAt(tree.effectors[e], problem.targets[e], problem.start.root_position));
    }
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3& axis = problem.start.root_frame[k];
      axes[k] = MakeQuad({axis.x, axis.y, axis.z}, 0);
    }
  }

  void Weigh();
  double TurnHinges();
  void PlaceLimbs();
  void MeasureGoals();
  double AngleOf(std::size_t dof) const;

  const WeightFormula formula;
  const double squared_position_goal, squared_axis_goal;
  const SweepTree tree;
  const std::vector<AngleRange> ranges;
  std::vector<double> middles;  // the zero point of each angle (`MiddleOf`), radians
  std::vector<HingeState> hinges;
  std::vector<GoalState> goals;
  std::vector<Quad> axes;  // ê of limbs, before and after each turn
  std::vector<Moments> moments;
};

// Computes the weights of the next sweep from the errors at the pose measured last.
void MomentSweep::State::Weigh() {
  for (GoalState& goal : goals) {
    goal.position_pull = goal.position_weight * formula.position;
    for (int k = 0; k < 3; ++k) goal.axis_pulls[k] = goal.axis_weights[k] * formula.axis;
    if (formula.power == ErrorPower::kNone) continue;
    goal.position_pull = goal.position_pull * PowerOf(std::sqrt(goal.squared_distance), formula.power);
    for (int k = 0; k < 3; ++k) {
      goal.axis_pulls[k] = goal.axis_pulls[k] * PowerOf(AngleOfChord(goal.squared_chords[k]), formula.power);
    }
  }
}

// Turns every hinge once, from the leaves to the root; limbs are not moved. Returns the squared chord of the largest
// turn.
double MomentSweep::State::TurnHinges() {
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    const SweepTree::Effector& effector = tree.effectors[e];
    AddEffector(effector, goals[e], moments[tree.joints[effector.joint].moments]);
  }
  double largest = 0;
  for (const SweepTree::Step& step : tree.steps) {
    const SweepTree::Joint& joint = tree.joints[step.joint];
    Moments& here = moments[joint.moments];
    if (step.hinge >= 0) {
      const double chord =
          TurnHinge(axes[step.from], axes[step.towards], hinges[step.hinge], here.rows[step.i], here.rows[step.j]);
      largest = chord >= largest ? chord : largest;
    } else if (joint.parent > 0) {  // the root does not turn and needs no moments
      PassToParent(joint, here, moments[tree.joints[joint.parent].moments]);
    }
  }
  return largest;
}

// Computes the forward kinematics from the root to the leaves, then the distances to the goals.
void MomentSweep::State::PlaceLimbs() {
  for (std::size_t n = tree.steps.size(); n-- > 0;) {
    const SweepTree::Step& step = tree.steps[n];
    // If the step is a hinge: rotate two axes by the hinge's angle.
    if (step.hinge >= 0) {
      const double c = hinges[step.hinge].c, s = hinges[step.hinge].s;
      const Quad from = axes[step.from], towards = axes[step.towards];
      axes[step.turned] = from * c + towards * s;
      axes[step.turned + 1] = towards * c - from * s;
      continue;
    }
    // If the step leads to the next limb: shift the axes by p_PJ, and rotate them unless R_PJ is the identity.
    const SweepTree::Joint& joint = tree.joints[step.joint];
    const int(&above)[3] = tree.joints[joint.parent].axes;
    if (joint.is_aligned) {
      for (int k = 0; k < 3; ++k) {
        if (joint.base[k] == above[k]) continue;  // this is the parent's own axis
        axes[joint.base[k]] = LessLast(axes[above[k]], joint.p_PJ[k]);
      }
      continue;
    }
    const double(&R_PJ)[3][3] = joint.R_PJ;
    const Quad x = LessLast(axes[above[0]], joint.p_PJ[0]);
    const Quad y = LessLast(axes[above[1]], joint.p_PJ[1]);
    const Quad z = LessLast(axes[above[2]], joint.p_PJ[2]);
    for (int c = 0; c < 3; ++c) axes[joint.base[c]] = Mix(x, R_PJ[0][c], y, R_PJ[1][c], z, R_PJ[2][c]);
  }
  MeasureGoals();
}

// Computes the squared distance of every effector from its goal, and the squared chord of each of its axes.
void MomentSweep::State::MeasureGoals() {
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    const SweepTree::Effector& effector = tree.effectors[e];
    const SweepTree::Joint& joint = tree.joints[effector.joint];
    GoalState& goal = goals[e];
    goal.squared_distance = 0;
    for (int k = 0; k < 3; ++k) {
      const Quad& axis = axes[joint.axes[k]];
      const double gap = Sum(axis * goal.position) - effector.p_LE[k];
      goal.squared_distance = goal.squared_distance + gap * gap;
      const Quad chord = axis - goal.axes[k];
      goal.squared_chords[k] = SumOfThree(chord * chord);
    }
  }
}

// Returns the angle of degree of freedom `dof`, radians, clamped to its range.
double MomentSweep::State::AngleOf(std::size_t dof) const {
  const HingeState& hinge = hinges[dof];
  const double from_middle = std::atan2(hinge.s * hinge.cos_middle - hinge.c * hinge.sin_middle,
                                        hinge.c * hinge.cos_middle + hinge.s * hinge.sin_middle);
  return std::clamp(middles[dof] + from_middle, ranges[dof].lower, ranges[dof].upper);
}

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

double MomentSweep::Turn() {
  state_->Weigh();
  return std::sqrt(state_->TurnHinges());
}

void MomentSweep::Measure() { state_->PlaceLimbs(); }

double MomentSweep::Merit() const {
  double merit = 0;
  for (const GoalState& goal : state_->goals) {
    merit += goal.position_pull * goal.squared_distance;
    for (int k = 0; k < 3; ++k) merit += goal.axis_pulls[k] * goal.squared_chords[k];
  }
  return merit;
}

void MomentSweep::ReadHalfTangents(std::span<double> out) const {
  for (std::size_t i = 0; i < out.size(); ++i) {
    const HingeState& hinge = state_->hinges[i];
    const double c = hinge.c * hinge.cos_middle + hinge.s * hinge.sin_middle;
    const double s = hinge.s * hinge.cos_middle - hinge.c * hinge.sin_middle;
    out[i] = c >= 0 ? s / (1 + c) : (1 - c) / s;  // two forms of tan(angle / 2); each is used where it is accurate
  }
}

void MomentSweep::SetHalfTangents(std::span<const double> half_tangents) {
  for (std::size_t i = 0; i < half_tangents.size(); ++i) {
    HingeState& hinge = state_->hinges[i];
    const double t = half_tangents[i], scale = 1 / (1 + t * t);
    // Cosine and sine of the angle before limits are applied, relative to the middle of its range.
    const double free_c = (1 - t * t) * scale, free_s = 2 * t * scale;
    const bool is_inside = free_c >= hinge.cos_half;
    const double c = is_inside ? free_c : hinge.cos_half;
    const double s = is_inside ? free_s : std::copysign(hinge.sin_half, t);
    hinge.c = c * hinge.cos_middle - s * hinge.sin_middle;
    hinge.s = s * hinge.cos_middle + c * hinge.sin_middle;
  }
}

bool MomentSweep::MissesGoals() const {
  double farthest = 0, worst = 0;
  for (const GoalState& goal : state_->goals) {
    const double distance = goal.position_share * goal.squared_distance;
    farthest = distance >= farthest ? distance : farthest;
  }
  if (farthest >= state_->squared_position_goal) return true;
  for (const GoalState& goal : state_->goals) {
    for (int k = 0; k < 3; ++k) {
      const double chord = goal.axis_shares[k] * goal.squared_chords[k];
      worst = chord >= worst ? chord : worst;
    }
  }
  return worst >= state_->squared_axis_goal;
}

std::vector<double> MomentSweep::Angles() const {
  std::vector<double> angles;
  for (std::size_t i = 0; i < state_->hinges.size(); ++i) angles.push_back(state_->AngleOf(i));
  return angles;
}

std::vector<EffectorError> MomentSweep::errors() const {
  std::vector<EffectorError> errors;
  for (std::size_t e = 0; e < state_->goals.size(); ++e) {
    const GoalState& goal = state_->goals[e];
    const int(&names)[3] = state_->tree.effectors[e].names;
    EffectorError& error = errors.emplace_back();
    error.position = std::sqrt(goal.squared_distance);
    for (int k = 0; k < 3; ++k) error.axis_angles[names[k]] = AngleOfChord(goal.squared_chords[k]);
  }
  return errors;
}

}  // namespace etude
