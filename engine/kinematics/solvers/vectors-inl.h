// A CPU's vectors as values with operators: in a `Lanes`, every lane belongs to another problem; a `Four` contains
// four doubles. This file is included once per instruction set, hence the unusual include guard. No operation of
// `Lanes` mixes lanes. No operation is a fused multiply-add, which rounds once where CPUs without it round twice.
// Square roots and quotients are rounded correctly on all CPUs. The results of a problem therefore do not depend on
// the width of the vectors.
#if defined(ETUDE_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ETUDE_VECTORS_INL_H_
#undef ETUDE_VECTORS_INL_H_
#else
#define ETUDE_VECTORS_INL_H_
#endif

#include <cstdint>
#include <cstring>

#include "hwy/aligned_allocator.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// ---- Vectors that hold the same number of several problems, one problem per lane ------------------------------------

template <class T, class D = hn::ScalableTag<T>>
struct LaneMask {
  hn::Mask<D> m;

  friend HWY_INLINE LaneMask operator!(const LaneMask& a) { return {hn::Not(a.m)}; }
  friend HWY_INLINE LaneMask operator||(const LaneMask& a, const LaneMask& b) { return {hn::Or(a.m, b.m)}; }
  friend HWY_INLINE LaneMask operator&&(const LaneMask& a, const LaneMask& b) { return {hn::And(a.m, b.m)}; }
  friend HWY_INLINE bool Any(const LaneMask& a) { return !hn::AllFalse(D(), a.m); }
};

/// A float or a double in every lane.
template <class T, class D = hn::ScalableTag<T>>
struct Lanes {
  using Number = T;
  using Tag = D;
  using Mask = LaneMask<T, D>;
  hn::Vec<Tag> v;

  Lanes() = default;
  HWY_INLINE explicit Lanes(double x) : v(hn::Set(Tag(), static_cast<T>(x))) {}
  HWY_INLINE explicit Lanes(hn::Vec<Tag> from) : v(from) {}

  friend HWY_INLINE Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(hn::Add(a.v, b.v)); }
  friend HWY_INLINE Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(hn::Sub(a.v, b.v)); }
  friend HWY_INLINE Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(hn::Mul(a.v, b.v)); }
  friend HWY_INLINE Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(hn::Div(a.v, b.v)); }
  friend HWY_INLINE Lanes Magnitude(const Lanes& a) { return Lanes(hn::Abs(a.v)); }
  friend HWY_INLINE Mask AtLeast(const Lanes& a, const Lanes& b) { return {hn::Ge(a.v, b.v)}; }
  friend HWY_INLINE Mask Below(const Lanes& a, const Lanes& b) { return {hn::Lt(a.v, b.v)}; }
  friend HWY_INLINE Mask AreEqual(const Lanes& a, const Lanes& b) { return {hn::Eq(a.v, b.v)}; }
  friend HWY_INLINE Lanes Select(const Mask& condition, const Lanes& yes, const Lanes& no) {
    return Lanes(hn::IfThenElse(condition.m, yes.v, no.v));
  }
  /// Returns `yes` where the condition holds, else 0.
  friend HWY_INLINE Lanes OrZero(const Mask& condition, const Lanes& yes) {
    return Lanes(hn::IfThenElseZero(condition.m, yes.v));
  }
};

/// Returns std::max(a, b) of each lane: `a` unless `b` is greater.
template <class V>
HWY_INLINE V Larger(const V& a, const V& b) {
  return Select(Below(a, b), b, a);
}

// A vector in memory is an array of its lanes.
template <class T, class D>
HWY_INLINE void SetLane(Lanes<T, D>& a, int lane, double x) {
  reinterpret_cast<T*>(&a)[lane] = static_cast<T>(x);
}
template <class T, class D>
HWY_INLINE double GetLane(const Lanes<T, D>& a, int lane) {
  return static_cast<double>(reinterpret_cast<const T*>(&a)[lane]);
}

// ---- Four doubles --------------------------------------------------------------------------------------------------

// A `Four` is stored as one vector, or as two on CPUs whose vectors have two doubles. It contains either one number of
// each of four limbs, or a row: numbers of one limb. Only functions for rows move numbers between lanes.

#if HWY_MAX_BYTES >= 32

using Four = Lanes<double, hn::FixedTag<double, 4>>;
using FourMask = LaneMask<double, Four::Tag>;

/// LoadFour and StoreFour need memory that is aligned for four doubles.
HWY_INLINE Four LoadFour(const double* from) { return Four(hn::Load(Four::Tag(), from)); }
HWY_INLINE void StoreFour(const Four& a, double* to) { hn::Store(a.v, Four::Tag(), to); }
/// Stores four doubles without alignment.
HWY_INLINE void PutFour(const Four& a, double* to) { hn::StoreU(a.v, Four::Tag(), to); }

HWY_INLINE double FirstOf(const Four& a) { return hn::GetLane(a.v); }

/// Returns (a1, a0, a3, a2).
HWY_INLINE Four SwapNeighbours(const Four& a) { return Four(hn::Shuffle01(a.v)); }
/// Returns (a2, a3, a0, a1).
HWY_INLINE Four SwapHalves(const Four& a) { return Four(hn::ConcatLowerUpper(Four::Tag(), a.v, a.v)); }
/// Returns (a0, a1, a0, a1).
HWY_INLINE Four LowerTwice(const Four& a) { return Four(hn::ConcatLowerLower(Four::Tag(), a.v, a.v)); }
/// Returns (a1, a2, a0, a3).
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

/// Transposes the four vectors a, b, 0, 0.
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

// ---- Rows of doubles -----------------------------------------------------------------------------------------------

/// A vector of the full width, for rows of doubles.
using RowVector = Lanes<double>;

/// Calls `act` with the index of every vector in a row of `count` doubles, a multiple of the vector width.
template <class Do>
HWY_INLINE void ForEachVector(std::size_t count, const Do& act) {
  constexpr std::size_t kLanes = sizeof(RowVector) / sizeof(double);
  for (std::size_t i = 0; i < count; i += kLanes) act(i);
}
HWY_INLINE RowVector LoadVector(const double* from) { return RowVector(hn::Load(RowVector::Tag(), from)); }
HWY_INLINE void StoreVector(const RowVector& a, double* to) { hn::Store(a.v, RowVector::Tag(), to); }

// ---- Memory --------------------------------------------------------------------------------------------------------

/// An array that is aligned for every vector type and zero-initialised.
template <class Item>
class AlignedList {
 public:
  explicit AlignedList(std::size_t size) : items_(hwy::AllocateAligned<Item>(size > 0 ? size : 1)), size_(size) {
    std::memset(static_cast<void*>(items_.get()), 0, size * sizeof(Item));
  }

  HWY_INLINE std::size_t size() const { return size_; }
  HWY_INLINE Item& operator[](std::size_t n) { return items_[n]; }
  HWY_INLINE const Item& operator[](std::size_t n) const { return items_[n]; }
  HWY_INLINE Item* begin() { return items_.get(); }
  HWY_INLINE Item* end() { return items_.get() + size_; }
  HWY_INLINE const Item* begin() const { return items_.get(); }
  HWY_INLINE const Item* end() const { return items_.get() + size_; }

 private:
  hwy::AlignedFreeUniquePtr<Item[]> items_;
  std::size_t size_;
};

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // ETUDE_VECTORS_INL_H_
