// One sweep of cyclic coordinate descent over a tree of hinges, in moment form (ours): what a hinge needs of all end
// effectors beyond it is carried from joint to joint as one 4×4 matrix, so the cost does not depend on how many there
// are, and angles are kept as (cos, sin), so the loop holds no trigonometry.
//
// For the current vectors of every effector E beyond a joint and the desired ones, of its target D,
//     M = Σ w_p (p_LE, 1)(p_WD, 1)ᵀ + Σ_k w_ok (u_kE_L, 0)(u_kD_W, 0)ᵀ,
// rows in the frame of the limb L, columns in the world W. A hinge that turns axis i of L towards axis j by the angle q
// gains
//     x cos q + y sin q,   x = M_i·ê_i + M_j·ê_j,   y = M_i·ê_j − M_j·ê_i,
// where M_i is a row and ê = (e_W, −p_WJ·e_W) an axis of the frame before the hinge: M_i·ê_j sums the current
// components along i times the desired ones along j, both from the joint J. So the best angle has the direction (x, y)
// (paper B's equations 3.10–3.13 for several effectors). A turn by it mixes the rows i and j; a step to the parent's
// joint, away by p_PJ, adds p_PJ[r] times the last row to the row r. Columns never change. Likewise ê is enough to
// place limbs: a turn mixes two of them, and a step by p_PJ takes p_PJ[k] off the last number of ê_k.
//
// Everything is written for a value V that has + − * / and, found by its type, Sqrt, Select, AtLeast, Any and SetLane:
// a double, or one lane each of many problems on the same tree. No operation mixes lanes and none is fused, so that a
// problem's results are the same bits in every lane, on every CPU. Compiled once per target (batch_lanes.cc), hence
// this kind of guard.
#if defined(ETUDE_SWEEP_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ETUDE_SWEEP_KERNEL_INL_H_
#undef ETUDE_SWEEP_KERNEL_INL_H_
#else
#define ETUDE_SWEEP_KERNEL_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/kinematics/solvers/lanes-inl.h"
#include "engine/kinematics/solvers/quad-inl.h"
#include "engine/kinematics/solvers/sweep_tree.h"
#include "engine/kinematics/weights.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

HWY_INLINE double Sqrt(double x) { return std::sqrt(x); }
HWY_INLINE double Select(bool condition, double yes, double no) { return condition ? yes : no; }
HWY_INLINE bool AtLeast(double a, double b) { return a >= b; }
HWY_INLINE bool Any(bool condition) { return condition; }
HWY_INLINE void SetLane(double& value, int /*lane*/, double x) { value = x; }

template <class V>
struct HingeOf {
  V c, s;  ///< of the angle
  V cos_middle, sin_middle, cos_half, sin_half;
};

template <class V>
struct MomentsOf {
  Quad<V> rows[4];
};

template <class V>
struct GoalOf {
  Quad<V> axes[3];   ///< (u_kD_W, 0)
  Quad<V> position;  ///< (p_WD, 1)
  V position_weight, axis_weights[3];
  V position_share, axis_shares[3];
  // Of the present angles, and the weights of a sweep.
  V squared_distance, squared_chords[3];
  V position_pull, axis_pulls[3];
};

/// All that sweeps of one problem, or of one lane each of many, work on.
template <class V>
struct SweepState {
  AlignedList<HingeOf<V>> hinges;
  AlignedList<GoalOf<V>> goals;
  AlignedList<Quad<V>> axes;  ///< ê of limbs, also before their turns
  AlignedList<MomentsOf<V>> moments;

  SweepState(const SweepTree& tree, int dof_count)
      : hinges(dof_count), goals(tree.effectors.size()), axes(tree.axis_count), moments(tree.moments_count) {}
};

/// Puts a problem at its start into one lane.
template <class V>
void LoadProblem(const SweepProblem& problem, int lane, SweepState<V>& state) {
  for (std::size_t d = 0; d < state.hinges.size(); ++d) {
    HingeOf<V>& hinge = state.hinges[d];
    const SweepProblem::Range& range = problem.range_numbers[d];
    SetLane(hinge.c, lane, problem.cosines[d]);
    SetLane(hinge.s, lane, problem.sines[d]);
    SetLane(hinge.cos_middle, lane, range.cos_middle);
    SetLane(hinge.sin_middle, lane, range.sin_middle);
    SetLane(hinge.cos_half, lane, range.cos_half);
    SetLane(hinge.sin_half, lane, range.sin_half);
  }
  for (std::size_t e = 0; e < state.goals.size(); ++e) {
    GoalOf<V>& goal = state.goals[e];
    const SweepProblem::Goal& from = problem.goals[e];
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) SetLane(goal.axes[k], i, lane, from.axes[k][i]);
      SetLane(goal.axes[k], 3, lane, 0);
      SetLane(goal.position, k, lane, from.position[k]);
      SetLane(goal.axis_weights[k], lane, from.axis_weights[k]);
      SetLane(goal.axis_shares[k], lane, from.axis_shares[k]);
    }
    SetLane(goal.position, 3, lane, 1);
    SetLane(goal.position_weight, lane, from.position_weight);
    SetLane(goal.position_share, lane, from.position_share);
  }
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) SetLane(state.axes[k], i, lane, problem.root_axes[k][i]);
    SetLane(state.axes[k], 3, lane, 0);
  }
}

template <class V>
HWY_INLINE Quad<V> Mix(const Quad<V>& x, double a, const Quad<V>& y, double b, const Quad<V>& z, double c) {
  return x * V(a) + y * V(b) + z * V(c);
}

/// How far every effector is from its goal.
template <class V>
void MeasureGoals(const SweepTree& tree, SweepState<V>& state) {
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    const SweepTree::Effector& effector = tree.effectors[e];
    const SweepTree::Joint& joint = tree.joints[effector.joint];
    GoalOf<V>& goal = state.goals[e];
    goal.squared_distance = V(0.0);
    for (int k = 0; k < 3; ++k) {
      const Quad<V>& axis = state.axes[joint.axes[k]];
      const V gap = Sum(axis * goal.position) - V(effector.p_LE[k]);
      goal.squared_distance = goal.squared_distance + gap * gap;
      const Quad<V> chord = axis - goal.axes[k];
      goal.squared_chords[k] = SumOfThree(chord * chord);
    }
  }
}

/// Forward kinematics, root to leaves, and what comes of it.
template <class V>
void PlaceLimbs(const SweepTree& tree, SweepState<V>& state) {
  for (std::size_t n = tree.steps.size(); n-- > 0;) {
    const SweepTree::Step& step = tree.steps[n];
    if (step.hinge >= 0) {
      const V c = state.hinges[step.hinge].c, s = state.hinges[step.hinge].s;
      const Quad<V> from = state.axes[step.from], towards = state.axes[step.towards];
      state.axes[step.turned] = from * c + towards * s;
      state.axes[step.turned + 1] = towards * c - from * s;
      continue;
    }
    const SweepTree::Joint& joint = tree.joints[step.joint];
    const int(&above)[3] = tree.joints[joint.parent].axes;
    if (joint.is_aligned) {
      for (int k = 0; k < 3; ++k) {
        if (joint.base[k] == above[k]) continue;  // the very same axis
        state.axes[joint.base[k]] = LessLast(state.axes[above[k]], V(joint.p_PJ[k]));
      }
      continue;
    }
    const double(&R_PJ)[3][3] = joint.R_PJ;
    const Quad<V> x = LessLast(state.axes[above[0]], V(joint.p_PJ[0]));
    const Quad<V> y = LessLast(state.axes[above[1]], V(joint.p_PJ[1]));
    const Quad<V> z = LessLast(state.axes[above[2]], V(joint.p_PJ[2]));
    for (int c = 0; c < 3; ++c) state.axes[joint.base[c]] = Mix(x, R_PJ[0][c], y, R_PJ[1][c], z, R_PJ[2][c]);
  }
  MeasureGoals(tree, state);
}

/// Turns a hinge to the best angle of its range, and with it the two rows of moments. Returns the square of the chord
/// of the turn, which is the turn itself when it is small.
template <class V>
HWY_INLINE V TurnHinge(const Quad<V>& from, const Quad<V>& towards, HingeOf<V>& hinge, Quad<V>& row_i, Quad<V>& row_j) {
  const Quad<V> a = row_i, b = row_j;
  const V x = Sum(a * from + b * towards);
  const V y = Sum(a * towards - b * from);
  const V square = x * x + y * y;
  const V length = Sqrt(square);
  // Outside its range, the end nearer on the circle has the larger gain; the lower one on a tie. Asked of (x, y) rather
  // than of its direction, so that nothing waits for the quotient.
  const auto is_inside = AtLeast(x * hinge.cos_middle + y * hinge.sin_middle, hinge.cos_half * length);
  const auto is_below = AtLeast(V(0.0), y * hinge.cos_middle - x * hinge.sin_middle);
  const V half_s = Select(is_below, V(0.0) - hinge.sin_half, hinge.sin_half);
  const V end_c = hinge.cos_middle * hinge.cos_half - hinge.sin_middle * half_s;
  const V end_s = hinge.sin_middle * hinge.cos_half + hinge.cos_middle * half_s;
  const auto is_flat = AtLeast(V(0.0), square);  // every angle is as good: stay
  const V scale = V(1.0) / Select(is_flat, V(1.0), length);
  const V old_c = hinge.c, old_s = hinge.s;
  const V c = Select(is_flat, old_c, Select(is_inside, x * scale, end_c));
  const V s = Select(is_flat, old_s, Select(is_inside, y * scale, end_s));
  hinge.c = c;
  hinge.s = s;
  row_i = a * c - b * s;
  row_j = b * c + a * s;
  const V dc = c - old_c, ds = s - old_s;
  return dc * dc + ds * ds;
}

template <class V>
HWY_INLINE void AddRow(bool is_first, const Quad<V>& row, Quad<V>& sum) {
  if (is_first) {
    sum = row;
  } else {
    sum = sum + row;
  }
}

/// What an effector brings to the moments of its limb.
template <class V>
void AddEffector(const SweepTree::Effector& effector, const GoalOf<V>& goal, MomentsOf<V>& moments) {
  const Quad<V> pull = goal.position * goal.position_pull;
  for (int r = 0; r < 3; ++r) {
    AddRow(effector.is_first, goal.axes[r] * goal.axis_pulls[r] + pull * V(effector.p_LE[r]), moments.rows[r]);
  }
  AddRow(effector.is_first, pull, moments.rows[3]);
}

/// Takes the moments of a limb, whose hinges have turned, to its parent's joint and frame, and adds them to those that
/// are there; if none are, both are in the same place.
template <class V>
void HandOn(const SweepTree::Joint& joint, MomentsOf<V>& child, MomentsOf<V>& parent) {
  if (!joint.is_aligned) {
    const double(&R_PJ)[3][3] = joint.R_PJ;
    const Quad<V> x = child.rows[0], y = child.rows[1], z = child.rows[2];
    for (int r = 0; r < 3; ++r) child.rows[r] = Mix(x, R_PJ[r][0], y, R_PJ[r][1], z, R_PJ[r][2]);
  }
  const Quad<V> last = child.rows[3];
  for (int r = 0; r < 3; ++r) {
    if (joint.p_PJ[r] != 0) child.rows[r] = child.rows[r] + last * V(joint.p_PJ[r]);
  }
  if (joint.is_first) return;
  for (int r = 0; r < 4; ++r) parent.rows[r] = parent.rows[r] + child.rows[r];
}

/// 2 asin(√chord² / 2), the angle of a chord of the unit circle, to 10⁻¹² of itself: a polynomial in (chord / 2)² up to
/// a right angle (minimax, ours), and beyond it by the chord of the rest of half a turn.
template <class V>
V AngleOfChord(const V& squared_chord) {
  constexpr double kTerms[] = {2.0000000000021307,   0.3333333319413167,  0.15000015042731862,  0.08927934444224939,
                               0.060903478193634814, 0.04293404585618574, 0.049655906059604696, -0.05387645705990194,
                               0.3244398378475416,   -0.7231340774880451, 1.199828495946593,    -1.102007953973178,
                               0.5043726115326342};
  const V whole = squared_chord * V(0.25);
  const auto is_small = AtLeast(V(0.5), whole);
  // Never below zero: rounding may make a chord longer than the circle is wide.
  const V rest = Select(AtLeast(V(1.0), whole), V(1.0) - whole, V(0.0));
  const V z = Select(is_small, whole, rest);
  V sum = V(kTerms[std::size(kTerms) - 1]);
  for (int k = static_cast<int>(std::size(kTerms)) - 2; k >= 0; --k) sum = sum * z + V(kTerms[k]);
  const V angle = Sqrt(z) * sum;
  return Select(is_small, angle, V(3.141592653589793) - angle);
}

template <class V>
V PowerOf(const V& x, ErrorPower power) {
  return power == ErrorPower::kThreeQuarters ? Sqrt(x * Sqrt(x)) : x;
}

/// The weights of the next sweep, by the errors of the present angles.
template <class V>
void WeighGoals(const WeightFormula& formula, SweepState<V>& state) {
  for (GoalOf<V>& goal : state.goals) {
    goal.position_pull = goal.position_weight * V(formula.position);
    for (int k = 0; k < 3; ++k) goal.axis_pulls[k] = goal.axis_weights[k] * V(formula.axis);
    if (formula.power == ErrorPower::kNone) continue;
    goal.position_pull = goal.position_pull * PowerOf(Sqrt(goal.squared_distance), formula.power);
    for (int k = 0; k < 3; ++k) {
      goal.axis_pulls[k] = goal.axis_pulls[k] * PowerOf(AngleOfChord(goal.squared_chords[k]), formula.power);
    }
  }
}

/// Turns every hinge once, leaves to root. Moves no limb. Returns the square of the largest chord of a turn.
template <class V>
V SweepHinges(const SweepTree& tree, const WeightFormula& formula, SweepState<V>& state) {
  WeighGoals(formula, state);
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    const SweepTree::Effector& effector = tree.effectors[e];
    AddEffector(effector, state.goals[e], state.moments[tree.joints[effector.joint].moments]);
  }
  V largest = V(0.0);
  for (const SweepTree::Step& step : tree.steps) {
    const SweepTree::Joint& joint = tree.joints[step.joint];
    MomentsOf<V>& moments = state.moments[joint.moments];
    if (step.hinge >= 0) {
      const V chord = TurnHinge(state.axes[step.from], state.axes[step.towards], state.hinges[step.hinge],
                                moments.rows[step.i], moments.rows[step.j]);
      largest = Select(AtLeast(chord, largest), chord, largest);
    } else if (joint.parent > 0) {  // the root does not turn and needs no moments
      HandOn(joint, moments, state.moments[tree.joints[joint.parent].moments]);
    }
  }
  return largest;
}

/// Whether an effector certainly misses its goals: no angle is smaller than its chord.
template <class V>
auto MissesGoals(const V& squared_position_goal, const V& squared_axis_goal, const SweepState<V>& state) {
  V farthest = V(0.0), worst = V(0.0);
  for (const GoalOf<V>& goal : state.goals) {
    const V distance = goal.position_share * goal.squared_distance;
    farthest = Select(AtLeast(distance, farthest), distance, farthest);
  }
  auto misses = AtLeast(farthest, squared_position_goal);
  if (!Any(!misses)) return misses;
  for (const GoalOf<V>& goal : state.goals) {
    for (int k = 0; k < 3; ++k) {
      const V chord = goal.axis_shares[k] * goal.squared_chords[k];
      worst = Select(AtLeast(chord, worst), chord, worst);
    }
  }
  return misses || AtLeast(worst, squared_axis_goal);
}

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // ETUDE_SWEEP_KERNEL_INL_H_
