#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "engine/kinematics/tree.h"

namespace etude {

// One sweep of cyclic coordinate descent over a tree of hinges, in moment form (ours): what a hinge needs of all end
// effectors below it is carried from joint to joint as sums, so the cost does not depend on how many there are, and
// angles are kept as (cos, sin), so the loop holds no trigonometry.
//
// For the vectors v of every effector below a joint (its position from the joint with weight w_p, its axes with w_ok),
// as they are now (v_c) and as they are wanted (v_d):  B = Σ w v_c v_dᵀ,  s_c = Σ w_p P_c,  s_d = Σ w_p P_d,  W = Σ
// w_p. Then paper B's sums for a hinge about axis a (equations 3.10–3.13) are k₁ = aᵀBa, k₂ = tr B, and k₃ is a's part
// of B's antisymmetric half.
//
// Everything is written for a value V that has + − * / and, found by its type, Sqrt, Select and AtLeast: a double, or
// one lane each of many problems on the same tree.

inline double Sqrt(double x) { return std::sqrt(x); }
inline double Select(bool condition, double yes, double no) { return condition ? yes : no; }
inline bool AtLeast(double a, double b) { return a >= b; }

/// A tree as the kernel reads it: constants of its joints, the same for every problem.
struct SweepTree {
  struct Joint {
    int parent = -1;
    int first_dof = 0;
    int dof_count = 0;
    bool is_aligned = false;  ///< `rest` is the identity, as between the limbs of an arm
    double rest[3][3] = {};   ///< rows: from the limb's frame into the parent limb's, when all angles are zero
    double offset[3] = {};    ///< from the parent's joint, in the parent limb's frame
  };
  struct Effector {
    int joint = 0;
    double offset[3] = {};
  };
  std::vector<Joint> joints;
  std::vector<Effector> effectors;
  /// Joints in the order of a sweep, each after all its children. Limbs that do not depend on each other take turns, so
  /// that a processor can work on several at once.
  std::vector<int> order;

  explicit SweepTree(const KinematicTree& tree);
};

/// An angle as the cosine and sine of its distance from the middle of its range, and that range.
template <class V>
struct Hinge {
  V c, s;                    ///< of q − middle
  V cos_middle, sin_middle;  ///< of the middle
  V cos_half, sin_half;      ///< of half the range; cos_half ≤ −1 when every angle is allowed

  V Cos() const { return c * cos_middle - s * sin_middle; }
  V Sin() const { return s * cos_middle + c * sin_middle; }
};

/// A 3×3 matrix by rows, and a vector.
template <class V>
struct Rows {
  V m[3][3];
};
template <class V>
struct Triple {
  V v[3];
};

/// A joint's limb in the world.
template <class V>
struct LimbOf {
  Rows<V> axes;  ///< columns are the limb's axes
  Triple<V> position;
};

/// What an effector is asked for, in the world.
template <class V>
struct GoalOf {
  Rows<V> axes;
  Triple<V> position;
  V position_weight;
  Triple<V> axis_weights;
};

template <class V>
struct Moments {
  Rows<V> b;
  Triple<V> now, wanted;
  V weight;
};

template <class V>
void ClearMoments(Moments<V>& moments) {
  for (auto& row : moments.b.m) {
    for (V& entry : row) entry = V(0.0);
  }
  for (V& entry : moments.now.v) entry = V(0.0);
  for (V& entry : moments.wanted.v) entry = V(0.0);
  moments.weight = V(0.0);
}

/// Adds an effector to the moments of the joint whose limb it ends, in that limb's frame.
template <class V>
void AddEffector(const SweepTree::Effector& effector, const LimbOf<V>& limb, const GoalOf<V>& goal,
                 Moments<V>& moments) {
  V to_goal[3];
  for (int i = 0; i < 3; ++i) to_goal[i] = goal.position.v[i] - limb.position.v[i];
  for (int col = 0; col < 3; ++col) {
    V wanted = V(0.0);
    for (int i = 0; i < 3; ++i) wanted = wanted + limb.axes.m[i][col] * to_goal[i];
    const V weighted = goal.position_weight * wanted;
    moments.wanted.v[col] = moments.wanted.v[col] + weighted;
    for (int row = 0; row < 3; ++row) {
      // Now, the effector's axes are the limb's own, and its place is fixed in the limb.
      V axis = V(0.0);
      for (int i = 0; i < 3; ++i) axis = axis + limb.axes.m[i][col] * goal.axes.m[i][row];
      moments.b.m[row][col] =
          moments.b.m[row][col] + goal.axis_weights.v[row] * axis + weighted * V(effector.offset[row]);
    }
  }
  for (int i = 0; i < 3; ++i) {
    moments.now.v[i] = moments.now.v[i] + goal.position_weight * V(effector.offset[i]);
  }
  moments.weight = moments.weight + goal.position_weight;
}

/// Turns a hinge about coordinate axis `kAxis` to the best angle of its range, and takes the moments from the frame
/// beyond the hinge to the one before it: what is, turns by the new angle; what is wanted, by the old. Returns the
/// square of the chord of the turn, which is the turn itself when it is small.
template <int kAxis, class V>
V TurnHinge(Hinge<V>& hinge, Moments<V>& moments) {
  constexpr int i = (kAxis + 1) % 3, j = (kAxis + 2) % 3;
  V(&b)[3][3] = moments.b.m;
  const V along = b[i][i] + b[j][j];   // k₂ − k₁
  const V across = b[i][j] - b[j][i];  // k₃
  const V length = Sqrt(along * along + across * across);
  const auto is_flat = AtLeast(V(0.0), length);
  const V scale = V(1.0) / Select(is_flat, V(1.0), length);
  const V turn_c = Select(is_flat, V(1.0), along * scale), turn_s = across * scale;

  const V old_c = hinge.c, old_s = hinge.s;
  const V old_cos = hinge.Cos(), old_sin = hinge.Sin();
  const V best_c = old_c * turn_c - old_s * turn_s;
  const V best_s = old_s * turn_c + old_c * turn_s;
  // Outside its range, the end nearer on the circle has the larger gain; the lower one on a tie.
  const auto is_inside = AtLeast(best_c, hinge.cos_half);
  const V end_s = Select(AtLeast(V(0.0), best_s), V(0.0) - hinge.sin_half, hinge.sin_half);
  hinge.c = Select(is_inside, best_c, hinge.cos_half);
  hinge.s = Select(is_inside, best_s, end_s);
  const V new_cos = hinge.Cos(), new_sin = hinge.Sin();

  for (int k = 0; k < 3; ++k) {
    const V upper = b[i][k], lower = b[j][k];
    b[i][k] = new_cos * upper - new_sin * lower;
    b[j][k] = new_sin * upper + new_cos * lower;
  }
  for (int k = 0; k < 3; ++k) {
    const V left = b[k][i], right = b[k][j];
    b[k][i] = old_cos * left - old_sin * right;
    b[k][j] = old_sin * left + old_cos * right;
  }
  const auto turn = [](Triple<V>& t, const V& c, const V& s) {
    const V x = t.v[i], y = t.v[j];
    t.v[i] = c * x - s * y;
    t.v[j] = s * x + c * y;
  };
  turn(moments.now, new_cos, new_sin);
  turn(moments.wanted, old_cos, old_sin);
  const V dc = hinge.c - old_c, ds = hinge.s - old_s;
  return dc * dc + ds * ds;
}

/// Takes moments from a joint's frame before it turns into its parent limb's, still about the joint.
template <class V>
void Align(const SweepTree::Joint& joint, Moments<V>& moments) {
  const auto apply = [&joint](V& x, V& y, V& z) {
    const V a = x, b = y, c = z;
    x = V(joint.rest[0][0]) * a + V(joint.rest[0][1]) * b + V(joint.rest[0][2]) * c;
    y = V(joint.rest[1][0]) * a + V(joint.rest[1][1]) * b + V(joint.rest[1][2]) * c;
    z = V(joint.rest[2][0]) * a + V(joint.rest[2][1]) * b + V(joint.rest[2][2]) * c;
  };
  V(&b)[3][3] = moments.b.m;
  for (int k = 0; k < 3; ++k) apply(b[0][k], b[1][k], b[2][k]);
  for (int k = 0; k < 3; ++k) apply(b[k][0], b[k][1], b[k][2]);
  apply(moments.now.v[0], moments.now.v[1], moments.now.v[2]);
  apply(moments.wanted.v[0], moments.wanted.v[1], moments.wanted.v[2]);
}

/// Adds a joint's moments, aligned with its parent's limb, to the parent's, which are about the parent's joint.
template <class V>
void AddToParent(const SweepTree::Joint& joint, const Moments<V>& child, Moments<V>& parent) {
  V wanted[3];  // about the parent's joint
  for (int c = 0; c < 3; ++c) wanted[c] = child.wanted.v[c] + child.weight * V(joint.offset[c]);
  for (int r = 0; r < 3; ++r) {
    const V t = V(joint.offset[r]);
    for (int c = 0; c < 3; ++c) {
      parent.b.m[r][c] = parent.b.m[r][c] + child.b.m[r][c] + child.now.v[r] * V(joint.offset[c]) + t * wanted[c];
    }
    parent.now.v[r] = parent.now.v[r] + child.now.v[r] + child.weight * t;
    parent.wanted.v[r] = parent.wanted.v[r] + wanted[r];
  }
  parent.weight = parent.weight + child.weight;
}

/// axes · R, the rotation of a hinge about coordinate axis `kAxis`.
template <int kAxis, class V>
void TurnColumns(const Hinge<V>& hinge, Rows<V>& axes) {
  constexpr int i = (kAxis + 1) % 3, j = (kAxis + 2) % 3;
  const V c = hinge.Cos(), s = hinge.Sin();
  for (auto& row : axes.m) {
    const V x = row[i], y = row[j];
    row[i] = c * x + s * y;
    row[j] = c * y - s * x;
  }
}

/// Forward kinematics: every limb in the world; `limbs[0]` is the root's and stays.
template <class V>
void PlaceLimbs(const SweepTree& tree, std::span<const Hinge<V>> hinges, std::span<LimbOf<V>> limbs) {
  for (std::size_t n = 0; n < tree.joints.size(); ++n) {
    const SweepTree::Joint& joint = tree.joints[n];
    if (joint.parent < 0) continue;
    const LimbOf<V>& above = limbs[joint.parent];
    LimbOf<V>& limb = limbs[n];
    for (int r = 0; r < 3; ++r) {
      const V a0 = above.axes.m[r][0], a1 = above.axes.m[r][1], a2 = above.axes.m[r][2];
      limb.position.v[r] =
          above.position.v[r] + a0 * V(joint.offset[0]) + a1 * V(joint.offset[1]) + a2 * V(joint.offset[2]);
      for (int c = 0; c < 3; ++c) {
        limb.axes.m[r][c] = joint.is_aligned
                                ? above.axes.m[r][c]
                                : a0 * V(joint.rest[0][c]) + a1 * V(joint.rest[1][c]) + a2 * V(joint.rest[2][c]);
      }
    }
    const Hinge<V>* hinge = &hinges[joint.first_dof];
    if (joint.dof_count > 0) TurnColumns<0>(hinge[0], limb.axes);
    if (joint.dof_count > 1) TurnColumns<1>(hinge[1], limb.axes);
    if (joint.dof_count > 2) TurnColumns<2>(hinge[2], limb.axes);
  }
}

/// One sweep, leaves to root: turns every hinge once. `limbs` are those of the hinges as they come in; they are not
/// updated. Returns the square of the largest chord that a hinge has turned by.
template <class V>
V SweepHinges(const SweepTree& tree, std::span<const LimbOf<V>> limbs, std::span<const GoalOf<V>> goals,
              std::span<Hinge<V>> hinges, std::span<Moments<V>> moments) {
  for (Moments<V>& m : moments) ClearMoments(m);
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    const SweepTree::Effector& effector = tree.effectors[e];
    AddEffector(effector, limbs[effector.joint], goals[e], moments[effector.joint]);
  }
  V largest = V(0.0);
  for (const int n : tree.order) {
    const SweepTree::Joint& joint = tree.joints[n];
    // The innermost axis is nearest to the leaves: turning it leaves the others' axes where they are.
    Hinge<V>* hinge = &hinges[joint.first_dof];
    const auto note = [&largest](const V& chord) { largest = Select(AtLeast(chord, largest), chord, largest); };
    if (joint.dof_count > 2) note(TurnHinge<2>(hinge[2], moments[n]));
    if (joint.dof_count > 1) note(TurnHinge<1>(hinge[1], moments[n]));
    if (joint.dof_count > 0) note(TurnHinge<0>(hinge[0], moments[n]));
    if (!joint.is_aligned) Align(joint, moments[n]);
    AddToParent(joint, moments[n], moments[joint.parent]);
  }
  return largest;
}

}  // namespace etude
