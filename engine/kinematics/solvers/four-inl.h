// Four doubles side by side, on every CPU: one vector, or two where vectors hold two. One number each of four limbs, or
// four numbers of a row; the latter alone may move from lane to lane. Compiled once per target, hence this kind of
// guard.
#if defined(ETUDE_FOUR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ETUDE_FOUR_INL_H_
#undef ETUDE_FOUR_INL_H_
#else
#define ETUDE_FOUR_INL_H_
#endif

#include <cstdint>

#include "engine/kinematics/solvers/lanes-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

#if HWY_MAX_BYTES >= 32

using Four = Lanes<double, hn::FixedTag<double, 4>>;
using FourMask = LaneMask<double, Four::Tag>;

/// `from` is aligned for four doubles, as is `to`.
HWY_INLINE Four LoadFour(const double* from) { return Four(hn::Load(Four::Tag(), from)); }
HWY_INLINE void StoreFour(const Four& a, double* to) { hn::Store(a.v, Four::Tag(), to); }
/// At any place.
HWY_INLINE void PutFour(const Four& a, double* to) { hn::StoreU(a.v, Four::Tag(), to); }

HWY_INLINE double FirstOf(const Four& a) { return hn::GetLane(a.v); }

/// (a1, a0, a3, a2)
HWY_INLINE Four SwapNeighbours(const Four& a) { return Four(hn::Shuffle01(a.v)); }
/// (a2, a3, a0, a1)
HWY_INLINE Four SwapHalves(const Four& a) { return Four(hn::ConcatLowerUpper(Four::Tag(), a.v, a.v)); }
/// (a0, a1, a0, a1)
HWY_INLINE Four LowerTwice(const Four& a) { return Four(hn::ConcatLowerLower(Four::Tag(), a.v, a.v)); }
/// (a1, a2, a0, a3)
HWY_INLINE Four NextAxes(const Four& a) {
  alignas(32) static constexpr std::int64_t kOrder[] = {1, 2, 0, 3};
  return Four(hn::TableLookupLanes(a.v, hn::SetTableIndices(Four::Tag(), kOrder)));
}

HWY_INLINE void Transpose(Four& a, Four& b, Four& c, Four& d) {
  constexpr Four::Tag kTag;
  const auto ab_even = hn::InterleaveLower(kTag, a.v, b.v), ab_odd = hn::InterleaveUpper(kTag, a.v, b.v);
  const auto cd_even = hn::InterleaveLower(kTag, c.v, d.v), cd_odd = hn::InterleaveUpper(kTag, c.v, d.v);
  a.v = hn::ConcatLowerLower(kTag, cd_even, ab_even);
  b.v = hn::ConcatLowerLower(kTag, cd_odd, ab_odd);
  c.v = hn::ConcatUpperUpper(kTag, cd_even, ab_even);
  d.v = hn::ConcatUpperUpper(kTag, cd_odd, ab_odd);
}

/// The same with zeros for `c` and `d` as they come.
HWY_INLINE void TransposeTwo(Four& a, Four& b, Four& c, Four& d) {
  constexpr Four::Tag kTag;
  constexpr hn::Half<Four::Tag> kHalf;
  const auto even = hn::InterleaveLower(kTag, a.v, b.v), odd = hn::InterleaveUpper(kTag, a.v, b.v);
  a.v = hn::ZeroExtendVector(kTag, hn::LowerHalf(kHalf, even));
  b.v = hn::ZeroExtendVector(kTag, hn::LowerHalf(kHalf, odd));
  c.v = hn::ZeroExtendVector(kTag, hn::UpperHalf(kHalf, even));
  d.v = hn::ZeroExtendVector(kTag, hn::UpperHalf(kHalf, odd));
}

#else

struct Four {
  using Two = Lanes<double, hn::FixedTag<double, 2>>;
  Two low, high;

  Four() = default;
  HWY_INLINE explicit Four(double x) : low(x), high(x) {}
  HWY_INLINE Four(const Two& a, const Two& b) : low(a), high(b) {}
};

struct FourMask {
  LaneMask<double, Four::Two::Tag> low, high;
};

HWY_INLINE Four operator+(const Four& a, const Four& b) { return {a.low + b.low, a.high + b.high}; }
HWY_INLINE Four operator-(const Four& a, const Four& b) { return {a.low - b.low, a.high - b.high}; }
HWY_INLINE Four operator*(const Four& a, const Four& b) { return {a.low * b.low, a.high * b.high}; }
HWY_INLINE Four operator/(const Four& a, const Four& b) { return {a.low / b.low, a.high / b.high}; }
HWY_INLINE Four Select(const FourMask& m, const Four& yes, const Four& no) {
  return {Select(m.low, yes.low, no.low), Select(m.high, yes.high, no.high)};
}
HWY_INLINE Four OrZero(const FourMask& m, const Four& yes) {
  return {OrZero(m.low, yes.low), OrZero(m.high, yes.high)};
}
HWY_INLINE FourMask Below(const Four& a, const Four& b) { return {Below(a.low, b.low), Below(a.high, b.high)}; }
HWY_INLINE FourMask AreEqual(const Four& a, const Four& b) {
  return {AreEqual(a.low, b.low), AreEqual(a.high, b.high)};
}
HWY_INLINE FourMask operator!(const FourMask& a) { return {!a.low, !a.high}; }
HWY_INLINE FourMask operator||(const FourMask& a, const FourMask& b) { return {a.low || b.low, a.high || b.high}; }
HWY_INLINE bool Any(const FourMask& a) { return Any(a.low || a.high); }

HWY_INLINE Four LoadFour(const double* from) {
  constexpr Four::Two::Tag kTag;
  return {Four::Two(hn::Load(kTag, from)), Four::Two(hn::Load(kTag, from + 2))};
}
HWY_INLINE void StoreFour(const Four& a, double* to) {
  constexpr Four::Two::Tag kTag;
  hn::Store(a.low.v, kTag, to);
  hn::Store(a.high.v, kTag, to + 2);
}
HWY_INLINE void PutFour(const Four& a, double* to) {
  constexpr Four::Two::Tag kTag;
  hn::StoreU(a.low.v, kTag, to);
  hn::StoreU(a.high.v, kTag, to + 2);
}
HWY_INLINE double FirstOf(const Four& a) { return hn::GetLane(a.low.v); }

HWY_INLINE Four SwapNeighbours(const Four& a) {
  return {Four::Two(hn::Shuffle01(a.low.v)), Four::Two(hn::Shuffle01(a.high.v))};
}
HWY_INLINE Four SwapHalves(const Four& a) { return {a.high, a.low}; }
HWY_INLINE Four LowerTwice(const Four& a) { return {a.low, a.low}; }
HWY_INLINE Four NextAxes(const Four& a) {
  constexpr Four::Two::Tag kTag;
  return {Four::Two(hn::CombineShiftRightBytes<8>(kTag, a.high.v, a.low.v)),
          Four::Two(hn::ConcatUpperLower(kTag, a.high.v, a.low.v))};
}

HWY_INLINE void Transpose(Four& a, Four& b, Four& c, Four& d) {
  using Two = Four::Two;
  using Tag = Two::Tag;
  const auto lower = [](const Two& x, const Two& y) HWY_ATTR { return Two(hn::InterleaveLower(Tag(), x.v, y.v)); };
  const auto upper = [](const Two& x, const Two& y) HWY_ATTR { return Two(hn::InterleaveUpper(Tag(), x.v, y.v)); };
  const Four first{lower(a.low, b.low), lower(c.low, d.low)}, second{upper(a.low, b.low), upper(c.low, d.low)};
  const Four third{lower(a.high, b.high), lower(c.high, d.high)}, last{upper(a.high, b.high), upper(c.high, d.high)};
  a = first;
  b = second;
  c = third;
  d = last;
}

HWY_INLINE void TransposeTwo(Four& a, Four& b, Four& c, Four& d) {
  c = d = Four(0.0);
  Transpose(a, b, c, d);
}

#endif

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // ETUDE_FOUR_INL_H_
