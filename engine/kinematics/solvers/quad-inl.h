#pragma once

#include "hwy/highway.h"

namespace etude {

namespace hn = hwy::HWY_NAMESPACE;  // for 128-bit vectors of two doubles, which every CPU has

using Pair = hn::FixedTag<double, 2>;

// A row of moments, or an axis ê (moment_sweep.cc), as two vectors, which take half the instructions of four numbers.
struct Quad {
  hn::Vec128<double> low, high;
};

inline Quad MakeQuad(const double (&three)[3], double last) {
  const double numbers[4] = {three[0], three[1], three[2], last};
  return {hn::LoadU(Pair(), numbers), hn::LoadU(Pair(), numbers + 2)};
}
HWY_INLINE Quad operator*(const Quad& a, const Quad& b) { return {a.low * b.low, a.high * b.high}; }
HWY_INLINE Quad operator*(const Quad& a, double b) {
  const auto both = hn::Set(Pair(), b);
  return {a.low * both, a.high * both};
}
HWY_INLINE Quad operator+(const Quad& a, const Quad& b) { return {a.low + b.low, a.high + b.high}; }
HWY_INLINE Quad operator-(const Quad& a, const Quad& b) { return {a.low - b.low, a.high - b.high}; }
// Returns `a` with `b` subtracted from its last number.
HWY_INLINE Quad LessLast(const Quad& a, double b) {
  return {a.low, a.high - hn::ShiftLeftLanes<1>(Pair(), hn::Set(Pair(), b))};
}
HWY_INLINE double Sum(const Quad& a) {
  const auto sums = a.low + a.high;
  return hn::GetLane(sums) + hn::GetLane(hn::Shuffle01(sums));
}
HWY_INLINE double SumOfThree(const Quad& a) { return hn::GetLane(a.low + a.high) + hn::GetLane(hn::Shuffle01(a.low)); }
HWY_INLINE Quad Mix(const Quad& x, double a, const Quad& y, double b, const Quad& z, double c) {
  return x * a + y * b + z * c;
}

}  // namespace etude
