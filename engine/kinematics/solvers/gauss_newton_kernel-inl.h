// The parts of a Gauss–Newton step (gauss_newton.h) and of its forward kinematics, for vectors of a type V. If V is
// `Lanes`, every lane belongs to another problem; if V is `Four`, every lane belongs to another limb of one problem.
// All operations are those of `ComputeFrames` and of the tests' `GaussNewtonStep` in the same order, so in double a
// problem's solution has the same bits in every lane on every CPU. This file is included once per instruction set,
// hence the unusual include guard.
#if defined(ETUDE_GAUSS_NEWTON_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ETUDE_GAUSS_NEWTON_KERNEL_INL_H_
#undef ETUDE_GAUSS_NEWTON_KERNEL_INL_H_
#else
#define ETUDE_GAUSS_NEWTON_KERNEL_INL_H_
#endif

#include <type_traits>

#include "engine/kinematics/solvers/vectors-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

/// `kPositionScale` squared, m².
inline constexpr double kSquaredPositionScale = 0.30 * 0.30;

// ---- Sine and cosine ------------------------------------------------------------------------------------------------

/// Computes sine and cosine of an angle from the sine `s` and cosine `c` of its remainder. The last bits of `shifted`
/// are the number n of quarter turns. If n is odd, sine and cosine are swapped. The sine changes its sign if the
/// second bit of n is set, the cosine if that bit of n + 1 is set.
template <class T>
HWY_INLINE void AddQuarters(const Lanes<T>& shifted, const Lanes<T>& s, const Lanes<T>& c, Lanes<T>& sine,
                            Lanes<T>& cosine) {
  using Tag = typename Lanes<T>::Tag;
  const hn::RebindToUnsigned<Tag> bits;
  constexpr int kToSign = 8 * sizeof(T) - 2;  // distance from the second lowest bit to the sign bit
  const auto quarter = hn::BitCast(bits, shifted.v), one = hn::Set(bits, 1u), two = hn::Set(bits, 2u);
  const auto s_bits = hn::BitCast(bits, s.v), c_bits = hn::BitCast(bits, c.v);
  const auto swap = hn::And(hn::Xor(s_bits, c_bits), hn::Sub(hn::Zero(bits), hn::And(quarter, one)));
  const auto s_sign = hn::ShiftLeft<kToSign>(hn::And(quarter, two));
  const auto c_sign = hn::ShiftLeft<kToSign>(hn::And(hn::Add(quarter, one), two));
  sine = Lanes<T>(hn::BitCast(Tag(), hn::Xor(hn::Xor(s_bits, swap), s_sign)));
  cosine = Lanes<T>(hn::BitCast(Tag(), hn::Xor(hn::Xor(c_bits, swap), c_sign)));
}

/// Computes sine and cosine in double, with the operations of `ComputeSineCosine`.
HWY_INLINE void SineAndCosine(const Lanes<double>& angle, Lanes<double>& sine, Lanes<double>& cosine) {
  using V = Lanes<double>;
  const V shifted = angle * V(0.6366197723675814) + V(0x1.8p52), quarters = shifted - V(0x1.8p52);
  const V r =
      ((angle - quarters * V(0x1.921fb544p+0)) - quarters * V(0x1.0b4611a6p-34)) - quarters * V(0x1.3198a2e037073p-69);
  const V z = r * r, z2 = z * z, z4 = z2 * z2;
  const V sine_tail = (V(-1.0 / 6) + z * V(1.0 / 120)) + z2 * (V(-1.0 / 5040) + z * V(1.0 / 362880)) +
                      z4 * ((V(-1.0 / 39916800) + z * V(1.0 / 6227020800)) +
                            z2 * (V(-1.0 / 1307674368000) + z * V(1.0 / 355687428096000)));
  const V cosine_tail = (V(1.0 / 24) - z * V(1.0 / 720)) + z2 * (V(1.0 / 40320) - z * V(1.0 / 3628800)) +
                        z4 * ((V(1.0 / 479001600) - z * V(1.0 / 87178291200)) + z2 * V(1.0 / 20922789888000));
  const V s = r + r * z * sine_tail;
  const V half = V(0.5) * z, rounded = V(1.0) - half;
  const V c = rounded + (((V(1.0) - rounded) - half) + z2 * cosine_tail);
  AddQuarters(shifted, s, c, sine, cosine);
}

/// Computes sine and cosine in float for |angle| ≤ 1000, within 2 units in the last place. The Taylor series up to r⁹
/// and r⁸ are accurate to 10⁻⁸.
HWY_INLINE void SineAndCosine(const Lanes<float>& angle, Lanes<float>& sine, Lanes<float>& cosine) {
  using V = Lanes<float>;
  const V shifted = angle * V(0.6366197723675814) + V(0x1.8p23), quarters = shifted - V(0x1.8p23);
  const V r = ((angle - quarters * V(0x1.92p+0)) - quarters * V(0x1.fb4p-12)) - quarters * V(0x1.4442d2p-24);
  const V z = r * r;
  const V s = r + r * z * ((V(-1.0 / 6) + z * V(1.0 / 120)) + z * z * (V(-1.0 / 5040) + z * V(1.0 / 362880)));
  const V c = V(1.0) - (V(0.5) * z - z * z * ((V(1.0 / 24) - z * V(1.0 / 720)) + z * z * V(1.0 / 40320)));
  AddQuarters(shifted, s, c, sine, cosine);
}

// ---- Vectors of three -----------------------------------------------------------------------------------------------

// Numbers are copied one by one: GCC copies arrays of vectors in narrow pieces, which stalls the next wide load.

template <class V>
HWY_INLINE V Dot3(const V (&a)[3], const V (&b)[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class V>
HWY_INLINE void Cross(const V (&a)[3], const V (&b)[3], V (&out)[3]) {
  out[0] = a[1] * b[2] - b[1] * a[2];
  out[1] = a[2] * b[0] - b[2] * a[0];
  out[2] = a[0] * b[1] - b[0] * a[1];
}

template <class V>
HWY_INLINE void Copy3(const V (&from)[3], V (&to)[3]) {
  for (int k = 0; k < 3; ++k) to[k] = from[k];
}

// ---- Forward kinematics ---------------------------------------------------------------------------------------------

template <class V>
struct FrameLanes {
  V axes[3][3];  ///< [axis][coordinate]
  V position[3];
};

/// Sets `out` to `axes` times the vector `by`, which converts `by` from the frame's coordinates to the world's.
template <class V>
HWY_INLINE void Mix(const V (&axes)[3][3], const V (&by)[3], V (&out)[3]) {
  for (int k = 0; k < 3; ++k) out[k] = axes[0][k] * by[0] + axes[1][k] * by[1] + axes[2][k] * by[2];
}

/// Rotates a frame by an angle, given by sine and cosine, about its axis `kAxis`.
template <int kAxis, class V>
HWY_INLINE void TurnAxes(const V& s, const V& c, V (&axes)[3][3]) {
  constexpr int i = (kAxis + 1) % 3, j = (kAxis + 2) % 3;
  for (int k = 0; k < 3; ++k) {
    const V x = axes[i][k], y = axes[j][k];
    axes[i][k] = c * x + s * y;
    axes[j][k] = c * y - s * x;
  }
}

/// Sets `screw` for a hinge at J: first its unit axis, then the translation, per radian, of the limb's point that
/// coincides with the root R.
template <class V>
HWY_INLINE void SetScrew(const V (&axis)[3], const V (&p_RJ_W)[3], V (&screw)[6]) {
  V shift[3];
  Cross(p_RJ_W, axis, shift);
  for (int k = 0; k < 3; ++k) {
    screw[k] = axis[k];
    screw[3 + k] = shift[k];
  }
}

// ---- Quadratics of targets ------------------------------------------------------------------------------------------

template <class V>
struct TargetLanes {
  V position[3];
  V axes[3][3];       ///< [axis][coordinate]
  V position_weight;  ///< weight of a squared error in units of `kPositionScale`²
  V axis_weights[3];
};

/// One target's quadratic ½VᵀΛV − ηᵀV in the limb's movement V (rotation, translation at the root), stored compactly.
template <class V>
struct TargetQuadraticLanes {
  V turn[6];  ///< rotation block of Λ: its lower triangle, row by row
  V lever[3];
  V weight;
  V vector[6];  ///< η
};

/// Λ is symmetric except for rounding. In double both triangles are stored, to give the same bits as scalar code.
/// In float, bits need not agree, so only the lower triangle is stored.
template <class V>
inline constexpr bool kHasUpperTriangle = !std::is_same_v<V, Lanes<float>>;

/// The sum of the quadratics of all targets beyond a limb, as full matrices.
template <class V>
struct QuadraticLanes {
  V matrix[36];  ///< Λ
  V vector[6];   ///< η
};

/// The residual of a pose, summed or maximised over its targets.
template <class V>
struct ResidualLanes {
  V squares;           ///< |e|²
  V squared_distance;  ///< largest squared distance of a position with weight, m²
  V squared_chord;     ///< largest squared chord |u_d − u_c|² of an axis with weight
};

/// Linearises one target at an effector's frame, and adds the effector's errors to `miss`.
template <class V>
HWY_INLINE void Linearise(const TargetLanes<V>& target, const V (&R_WE)[3][3], const V (&p_WE)[3], const V (&p_WR)[3],
                          TargetQuadraticLanes<V>& asked, ResidualLanes<V>& miss) {
  // Compute the weighted position error, its moment about the root, and its part of the residual.
  const V w = target.position_weight;
  V p_RE_W[3], p_ED_W[3], pull[3], twist[3];
  for (int k = 0; k < 3; ++k) {
    p_RE_W[k] = p_WE[k] - p_WR[k];
    p_ED_W[k] = target.position[k] - p_WE[k];
    pull[k] = w * p_ED_W[k];
  }
  Cross(p_RE_W, pull, twist);
  V squares = Dot3(pull, p_ED_W);
  const V nothing(0.0);
  miss.squared_distance = Larger(miss.squared_distance, Select(Below(nothing, w), Dot3(p_ED_W, p_ED_W), nothing));
  for (int k = 0; k < 3; ++k) {
    // Compute the moment of the error of axis k, its chord, and its part of the residual.
    const V u = target.axis_weights[k];
    V cross[3], chord[3];
    Cross(R_WE[k], target.axes[k], cross);
    for (int i = 0; i < 3; ++i) {
      twist[i] = twist[i] + cross[i] * u;
      chord[i] = target.axes[k][i] - R_WE[k][i];
    }
    squares = squares + V(2.0) * u * (V(1.0) - Dot3(R_WE[k], target.axes[k]));
    miss.squared_chord = Larger(miss.squared_chord, Select(Below(nothing, u), Dot3(chord, chord), nothing));
  }
  // Compute Λ and η (see the tests' `GaussNewtonStep::LineariseTarget`).
  const V ux = target.axis_weights[0], uy = target.axis_weights[1], uz = target.axis_weights[2];
  const V straight = w * Dot3(p_RE_W, p_RE_W) + ux + uy + uz;
  for (int k = 0; k < 3; ++k) asked.lever[k] = p_RE_W[k] * w;
  int cell = 0;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c <= r; ++c) {
      const V along = asked.lever[r] * p_RE_W[c] + ux * R_WE[0][r] * R_WE[0][c] + uy * R_WE[1][r] * R_WE[1][c] +
                      uz * R_WE[2][r] * R_WE[2][c];
      asked.turn[cell++] = (r == c ? straight : nothing) - along;
    }
    asked.vector[r] = twist[r];
    asked.vector[3 + r] = pull[r];
  }
  asked.weight = w;
  miss.squares = miss.squares + squares;
}

/// Expands the quadratic of one target into full matrices Λ and η. Replaces `sum` by Λ and η, or adds these to `sum`.
template <bool kIsFirst, class V>
HWY_INLINE void Gather(const TargetQuadraticLanes<V>& asked, QuadraticLanes<V>& sum) {
  // `put` sets an entry of Λ or adds to the entry. Vectors of floats keep only the lower triangle of Λ.
  const V nothing(0.0);
  const auto put = [&](int row, int column, const V& x) HWY_ATTR {
    if (!kHasUpperTriangle<V> && column > row) return;
    V& cell = sum.matrix[6 * row + column];
    cell = kIsFirst ? x : cell + x;
  };
  // Fill the rotation block, the translation block, and the two blocks between them, then η.
  int cell = 0;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c <= r; ++c) {
      put(r, c, asked.turn[cell]);
      if (c < r) put(c, r, asked.turn[cell]);
      ++cell;
      put(3 + r, 3 + c, r == c ? asked.weight : nothing);
      if (c < r) put(3 + c, 3 + r, nothing);
    }
    const int i = (r + 1) % 3, j = (r + 2) % 3;
    const V back = nothing - asked.lever[r];
    put(r, 3 + r, nothing);
    put(3 + r, r, nothing);
    put(i, 3 + j, back);
    put(3 + j, i, back);
    put(j, 3 + i, asked.lever[r]);
    put(3 + i, j, asked.lever[r]);
  }
  for (int k = 0; k < 6; ++k) sum.vector[k] = kIsFirst ? asked.vector[k] : sum.vector[k] + asked.vector[k];
}

// ---- The step -------------------------------------------------------------------------------------------------------

template <class V>
struct HingeLanes {
  V screw[6], matrix_s[6];
  V scale, best;
  V side;  ///< −1 if fixed at the lower end of its range, 1 at the upper end, 0 if free
  V change;
};

template <class V>
HWY_INLINE V Dot6(const V (&a)[6], const V (&b)[6]) {
  return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]) + (a[4] * b[4] + a[5] * b[5]);
}

/// Eliminates a hinge from its limb's quadratic. `pull` is the change of the hinge's angle that leads to the preferred
/// angle; `lower` and `upper` are the changes that lead to the ends of its range.
template <class V>
HWY_INLINE void EliminateHinge(const V& damping, const V& pull, const V& lower, const V& upper, QuadraticLanes<V>& limb,
                               HingeLanes<V>& hinge) {
  V* HWY_RESTRICT m = limb.matrix;
  V s[6], y[6];
  for (int k = 0; k < 6; ++k) s[k] = hinge.screw[k];
  // y = Λs.
  const auto times = [&](int row, int column) HWY_ATTR {
    const bool is_kept = kHasUpperTriangle<V> || column <= row;
    return m[is_kept ? 6 * row + column : 6 * column + row] * s[row];
  };
  for (int i = 0; i < 6; ++i)
    y[i] = (times(0, i) + times(1, i)) + (times(2, i) + times(3, i)) + (times(4, i) + times(5, i));
  // Compute the change that is best if the limb before the hinge does not move. If the hinge is fixed, its change leads
  // to the end of its range.
  const V nothing(0.0);
  const V scale = V(1.0) / (damping + Larger(nothing, Dot6(y, s)));
  const V best = scale * (damping * pull + Dot6(limb.vector, s));
  const auto is_free = AreEqual(hinge.side, nothing);
  const V change = Select(is_free, best, Select(Below(hinge.side, nothing), lower, upper));
  // Subtract the hinge's part from Λ by adding the negative of it: an addition can take either operand from memory,
  // which saves an instruction.
  const V share = OrZero(is_free, nothing - scale);
  for (int r = 0; r < 6; ++r) {
    const V row_share = share * y[r];
    for (int i = 0; i < (kHasUpperTriangle<V> ? 6 : r + 1); ++i) m[6 * r + i] = m[6 * r + i] + row_share * y[i];
  }
  // Subtract from η what the hinge's change already contributes.
  const V back = nothing - change;
  for (int k = 0; k < 6; ++k) {
    limb.vector[k] = limb.vector[k] + back * y[k];
    hinge.matrix_s[k] = y[k];
  }
  hinge.scale = scale;
  hinge.best = best;
}

/// Returns `x`, clamped to [lower, upper].
template <class V>
HWY_INLINE V Clamped(const V& x, const V& lower, const V& upper) {
  return Select(Below(x, lower), lower, Select(Below(upper, x), upper, x));
}

/// Computes the hinge's change and side. `movement` is first the movement of the limb before the hinge, and afterwards
/// the movement of the limb beyond it.
template <class V>
HWY_INLINE void SubstituteHinge(const V& lower, const V& upper, const HingeLanes<V>& hinge, V& change, V& side,
                                V (&movement)[6]) {
  const V best = hinge.best - hinge.scale * Dot6(hinge.matrix_s, movement);
  const auto is_below = Below(best, lower);
  const auto is_above = Below(upper, best);
  side = Select(is_below, V(-1.0), OrZero(is_above, V(1.0)));
  change = Select(is_below, lower, Select(is_above, upper, best));
  for (int k = 0; k < 6; ++k) movement[k] = movement[k] + change * hinge.screw[k];
}

// ---- The step for one limb, by rows --------------------------------------------------------------------------------

// The rows have six numbers. Every sum is taken in the same order as in the code for `Lanes` above.

/// Six numbers and two zeros.
struct SixRow {
  Four low, high;
};

HWY_INLINE SixRow LoadRow(const double* from) { return {LoadFour(from), LoadFour(from + 4)}; }
HWY_INLINE void StoreRow(const SixRow& a, double* to) {
  StoreFour(a.low, to);
  StoreFour(a.high, to + 4);
}
HWY_INLINE SixRow operator+(const SixRow& a, const SixRow& b) { return {a.low + b.low, a.high + b.high}; }
HWY_INLINE SixRow operator-(const SixRow& a, const SixRow& b) { return {a.low - b.low, a.high - b.high}; }
HWY_INLINE SixRow operator*(const Four& a, const SixRow& b) { return {a * b.low, a * b.high}; }

/// Returns `Dot6` of two rows, repeated in every lane.
HWY_INLINE Four DotRows(const SixRow& a, const SixRow& b) {
  const Four low = a.low * b.low, high = a.high * b.high;
  const Four pairs = low + SwapNeighbours(low), last = high + SwapNeighbours(high);
  return (pairs + SwapHalves(pairs)) + LowerTwice(last);
}

/// Transposes six vectors of four lanes into one row per lane, at `row_of(lane)`.
template <class RowOf>
HWY_INLINE void PutRows(const Four* numbers, const RowOf& row_of) {
  Four a = numbers[0], b = numbers[1], c = numbers[2], d = numbers[3];
  Transpose(a, b, c, d);
  Four e = numbers[4], f = numbers[5], g, h;
  TransposeTwo(e, f, g, h);
  row_of(0) = {a, e};
  row_of(1) = {b, f};
  row_of(2) = {c, g};
  row_of(3) = {d, h};
}

/// The quadratic of one limb, Λ and η as in `QuadraticLanes`, stored by rows.
struct QuadraticRows {
  SixRow matrix[6];
  SixRow vector;
};

/// The frame of one trunk limb, as in `FrameLanes`.
struct TrunkFrame {
  Four axes[3];  ///< each as x, y, z, 0
  Four position;
};

/// The state of one trunk hinge, as in `HingeLanes`.
struct alignas(64) TrunkHinge {
  double screw[8], matrix_s[8];
  double scale, best, side;
};

/// Returns the cross product a × b of vectors that are stored as x, y, z, 0.
HWY_INLINE Four CrossAxes(const Four& a, const Four& b) {
  return NextAxes(a) * NextAxes(NextAxes(b)) - NextAxes(b) * NextAxes(NextAxes(a));
}

/// Eliminates a hinge from the quadratic (m, v) of its limb.
HWY_INLINE void EliminateHinge(const Four& damping, double to_start, double to_lower, double to_upper, SixRow (&m)[6],
                               SixRow& v, TrunkHinge& hinge) {
  const double* s = hinge.screw;
  const SixRow screw = LoadRow(s);
  const SixRow y = (Four(s[0]) * m[0] + Four(s[1]) * m[1]) + (Four(s[2]) * m[2] + Four(s[3]) * m[3]) +
                   (Four(s[4]) * m[4] + Four(s[5]) * m[5]);
  StoreRow(y, hinge.matrix_s);
  const Four nothing(0.0);
  const Four scale = Four(1.0) / (damping + Larger(nothing, DotRows(y, screw)));
  const Four best = scale * (damping * Four(to_start) + DotRows(v, screw));
  const Four side(hinge.side);
  const auto is_free = AreEqual(side, nothing);
  const Four change = Select(is_free, best, Select(Below(side, nothing), Four(to_lower), Four(to_upper)));
  const Four share = OrZero(is_free, nothing - scale);
  for (int r = 0; r < 6; ++r) m[r] = m[r] + (share * Four(hinge.matrix_s[r])) * y;
  v = v + (nothing - change) * y;
  hinge.scale = FirstOf(scale);
  hinge.best = FirstOf(best);
}

/// Computes the hinge's change. `movement` is first the movement of the limb before the hinge, and afterwards the
/// movement of the limb beyond it. Returns true if the hinge's `side` has changed.
HWY_INLINE bool SubstituteHinge(double to_lower, double to_upper, TrunkHinge& hinge, double& change, SixRow& movement) {
  const Four best = Four(hinge.best) - Four(hinge.scale) * DotRows(LoadRow(hinge.matrix_s), movement);
  const Four lower(to_lower), upper(to_upper);
  const auto is_below = Below(best, lower), is_above = Below(upper, best);
  const Four moved = Select(is_below, lower, Select(is_above, upper, best));
  movement = movement + moved * LoadRow(hinge.screw);
  const double side = FirstOf(Select(is_below, Four(-1.0), OrZero(is_above, Four(1.0))));
  const bool has_changed = side != hinge.side;
  hinge.side = side;
  change = FirstOf(moved);
  return has_changed;
}

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // ETUDE_GAUSS_NEWTON_KERNEL_INL_H_
