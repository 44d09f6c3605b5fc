// The parts of a Gauss–Newton step for one limb by rows, six numbers at a time: every sum in the order in which
// gauss_newton_kernel-inl.h has it for lanes. Compiled once per target, hence this kind of guard.
#if defined(ETUDE_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ETUDE_ROWS_INL_H_
#undef ETUDE_ROWS_INL_H_
#else
#define ETUDE_ROWS_INL_H_
#endif

#include "engine/kinematics/solvers/four-inl.h"
#include "engine/kinematics/solvers/gauss_newton_kernel-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

/// Six numbers in a row, and two zeros.
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

/// `Dot6` of two rows, in every lane.
HWY_INLINE Four DotRows(const SixRow& a, const SixRow& b) {
  const Four low = a.low * b.low, high = a.high * b.high;
  const Four pairs = low + SwapNeighbours(low), last = high + SwapNeighbours(high);
  return (pairs + SwapHalves(pairs)) + LowerTwice(last);
}

/// What is asked of a limb: `QuadraticLanes` of one.
struct QuadraticRows {
  SixRow matrix[6];
  SixRow vector;
};

/// `FrameLanes` of one.
struct TrunkFrame {
  Four axes[3];  ///< x, y, z, 0
  Four position;
};

/// `HingeLanes` of one.
struct alignas(64) TrunkHinge {
  double screw[8], matrix_s[8];
  double scale, best, side;
};

/// a × b of x, y, z, 0
HWY_INLINE Four CrossAxes(const Four& a, const Four& b) {
  return NextAxes(a) * NextAxes(NextAxes(b)) - NextAxes(b) * NextAxes(NextAxes(a));
}

/// Takes a hinge's part off what is asked of its limb, (m, v).
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

/// The hinge's change, as its limb moves now, and with it the movement of the limb beyond. Returns whether it has
/// changed sides.
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
#endif  // ETUDE_ROWS_INL_H_
