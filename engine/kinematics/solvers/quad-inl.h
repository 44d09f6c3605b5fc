// Four values side by side: a row of moments, or an axis with what belongs to it. Compiled once per target
// (batch_lanes.cc), hence this kind of guard.
#if defined(ETUDE_QUAD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ETUDE_QUAD_INL_H_
#undef ETUDE_QUAD_INL_H_
#else
#define ETUDE_QUAD_INL_H_
#endif

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

template <class V>
struct Quad {
  V v[4];

  Quad() = default;
  HWY_INLINE Quad(const V& a, const V& b, const V& c, const V& d) : v{a, b, c, d} {}
  // One by one: GCC copies whole arrays of vectors in pieces that are too narrow to be read back at once.
  HWY_INLINE Quad(const Quad& other) : v{other.v[0], other.v[1], other.v[2], other.v[3]} {}
  // NOLINTNEXTLINE(bugprone-unhandled-self-assignment): all is read before any is written.
  HWY_INLINE Quad& operator=(const Quad& other) {
    const V a = other.v[0], b = other.v[1], c = other.v[2], d = other.v[3];
    v[0] = a;
    v[1] = b;
    v[2] = c;
    v[3] = d;
    return *this;
  }
};

template <class V>
HWY_INLINE Quad<V> operator*(const Quad<V>& a, const Quad<V>& b) {
  return {a.v[0] * b.v[0], a.v[1] * b.v[1], a.v[2] * b.v[2], a.v[3] * b.v[3]};
}
template <class V>
HWY_INLINE Quad<V> operator*(const Quad<V>& a, const V& b) {
  return {a.v[0] * b, a.v[1] * b, a.v[2] * b, a.v[3] * b};
}
template <class V>
HWY_INLINE Quad<V> operator+(const Quad<V>& a, const Quad<V>& b) {
  return {a.v[0] + b.v[0], a.v[1] + b.v[1], a.v[2] + b.v[2], a.v[3] + b.v[3]};
}
template <class V>
HWY_INLINE Quad<V> operator-(const Quad<V>& a, const Quad<V>& b) {
  return {a.v[0] - b.v[0], a.v[1] - b.v[1], a.v[2] - b.v[2], a.v[3] - b.v[3]};
}
/// `a` with its last value less by `b`.
template <class V>
HWY_INLINE Quad<V> LessLast(const Quad<V>& a, const V& b) {
  return {a.v[0], a.v[1], a.v[2], a.v[3] - b};
}
/// Sums in the one order in which a pair of pairs can do it, too.
template <class V>
HWY_INLINE V Sum(const Quad<V>& a) {
  return (a.v[0] + a.v[2]) + (a.v[1] + a.v[3]);
}
template <class V>
HWY_INLINE V SumOfThree(const Quad<V>& a) {
  return (a.v[0] + a.v[2]) + a.v[1];
}

/// Puts `x` into one lane of a value, and of one of four values.
template <class V>
HWY_INLINE void SetLane(Quad<V>& a, int k, int lane, double x) {
  SetLane(a.v[k], lane, x);
}

/// Of one double each, four values are two of the narrowest vectors, which every CPU has: half the instructions, and
/// the same results as from four doubles.
template <>
struct Quad<double> {
  hwy::HWY_NAMESPACE::Vec128<double> low, high;
};
using Pair = hwy::HWY_NAMESPACE::FixedTag<double, 2>;

HWY_INLINE Quad<double> operator*(const Quad<double>& a, const Quad<double>& b) {
  return {a.low * b.low, a.high * b.high};
}
HWY_INLINE Quad<double> operator*(const Quad<double>& a, double b) {
  const auto both = hwy::HWY_NAMESPACE::Set(Pair(), b);
  return {a.low * both, a.high * both};
}
HWY_INLINE Quad<double> operator+(const Quad<double>& a, const Quad<double>& b) {
  return {a.low + b.low, a.high + b.high};
}
HWY_INLINE Quad<double> operator-(const Quad<double>& a, const Quad<double>& b) {
  return {a.low - b.low, a.high - b.high};
}
HWY_INLINE Quad<double> LessLast(const Quad<double>& a, double b) {
  namespace hn = hwy::HWY_NAMESPACE;
  return {a.low, a.high - hn::ShiftLeftLanes<1>(Pair(), hn::Set(Pair(), b))};
}
HWY_INLINE double Sum(const Quad<double>& a) {
  namespace hn = hwy::HWY_NAMESPACE;
  const auto sums = a.low + a.high;
  return hn::GetLane(sums) + hn::GetLane(hn::Shuffle01(sums));
}
HWY_INLINE double SumOfThree(const Quad<double>& a) {
  namespace hn = hwy::HWY_NAMESPACE;
  return hn::GetLane(a.low + a.high) + hn::GetLane(hn::Shuffle01(a.low));
}

HWY_INLINE void SetLane(Quad<double>& a, int k, int /*lane*/, double x) {
  auto& pair = k < 2 ? a.low : a.high;
  pair = hwy::HWY_NAMESPACE::InsertLane(pair, k % 2, x);
}

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // ETUDE_QUAD_INL_H_
