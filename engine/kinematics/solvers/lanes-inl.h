// One value of each of many problems, side by side in a CPU's vector. Compiled once per target, hence this kind of
// guard. No operation mixes lanes, and none is fused: MulAdd rounds once where CPUs without it round twice. Roots and
// quotients are exact everywhere, so that what a problem gets does not depend on the width of the vectors.
#if defined(ETUDE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ETUDE_LANES_INL_H_
#undef ETUDE_LANES_INL_H_
#else
#define ETUDE_LANES_INL_H_
#endif

#include <algorithm>
#include <cstring>

#include "hwy/aligned_allocator.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A float or a double in every lane.
template <class T, class D = hn::ScalableTag<T>>
struct Lanes {
  using Number = T;
  using Tag = D;
  hn::Vec<Tag> v;

  Lanes() = default;
  HWY_INLINE explicit Lanes(double x) : v(hn::Set(Tag(), static_cast<T>(x))) {}
  HWY_INLINE explicit Lanes(hn::Vec<Tag> from) : v(from) {}
};

template <class T, class D = hn::ScalableTag<T>>
struct LaneMask {
  hn::Mask<D> m;
};

template <class T, class D>
HWY_INLINE Lanes<T, D> operator+(const Lanes<T, D>& a, const Lanes<T, D>& b) {
  return Lanes<T, D>(hn::Add(a.v, b.v));
}
template <class T, class D>
HWY_INLINE Lanes<T, D> operator-(const Lanes<T, D>& a, const Lanes<T, D>& b) {
  return Lanes<T, D>(hn::Sub(a.v, b.v));
}
template <class T, class D>
HWY_INLINE Lanes<T, D> operator*(const Lanes<T, D>& a, const Lanes<T, D>& b) {
  return Lanes<T, D>(hn::Mul(a.v, b.v));
}
template <class T, class D>
HWY_INLINE Lanes<T, D> operator/(const Lanes<T, D>& a, const Lanes<T, D>& b) {
  return Lanes<T, D>(hn::Div(a.v, b.v));
}
template <class T, class D>
HWY_INLINE Lanes<T, D> Sqrt(const Lanes<T, D>& a) {
  return Lanes<T, D>(hn::Sqrt(a.v));
}
template <class T, class D>
HWY_INLINE Lanes<T, D> Magnitude(const Lanes<T, D>& a) {
  return Lanes<T, D>(hn::Abs(a.v));
}
template <class T, class D>
HWY_INLINE Lanes<T, D> Select(const LaneMask<T, D>& condition, const Lanes<T, D>& yes, const Lanes<T, D>& no) {
  return Lanes<T, D>(hn::IfThenElse(condition.m, yes.v, no.v));
}
/// Zero where the condition does not hold.
template <class T, class D>
HWY_INLINE Lanes<T, D> OrZero(const LaneMask<T, D>& condition, const Lanes<T, D>& yes) {
  return Lanes<T, D>(hn::IfThenElseZero(condition.m, yes.v));
}
template <class T, class D>
HWY_INLINE LaneMask<T, D> AtLeast(const Lanes<T, D>& a, const Lanes<T, D>& b) {
  return {hn::Ge(a.v, b.v)};
}
template <class T, class D>
HWY_INLINE LaneMask<T, D> Below(const Lanes<T, D>& a, const Lanes<T, D>& b) {
  return {hn::Lt(a.v, b.v)};
}
template <class T, class D>
HWY_INLINE LaneMask<T, D> AreEqual(const Lanes<T, D>& a, const Lanes<T, D>& b) {
  return {hn::Eq(a.v, b.v)};
}
template <class T, class D>
HWY_INLINE LaneMask<T, D> operator!(const LaneMask<T, D>& a) {
  return {hn::Not(a.m)};
}
template <class T, class D>
HWY_INLINE LaneMask<T, D> operator||(const LaneMask<T, D>& a, const LaneMask<T, D>& b) {
  return {hn::Or(a.m, b.m)};
}
template <class T, class D>
HWY_INLINE LaneMask<T, D> operator&&(const LaneMask<T, D>& a, const LaneMask<T, D>& b) {
  return {hn::And(a.m, b.m)};
}
template <class T, class D>
HWY_INLINE bool Any(const LaneMask<T, D>& a) {
  return !hn::AllFalse(D(), a.m);
}

/// As std::max(a, b) and std::min(a, b): the first, unless the second is really larger or smaller.
template <class V>
HWY_INLINE V Larger(const V& a, const V& b) {
  return Select(Below(a, b), b, a);
}
template <class V>
HWY_INLINE V Smaller(const V& a, const V& b) {
  return Select(Below(b, a), b, a);
}

// A vector in memory is its lanes in a row.
template <class T, class D>
HWY_INLINE void SetLane(Lanes<T, D>& a, int lane, double x) {
  reinterpret_cast<T*>(&a)[lane] = static_cast<T>(x);
}
template <class T, class D>
HWY_INLINE double GetLane(const Lanes<T, D>& a, int lane) {
  return static_cast<double>(reinterpret_cast<const T*>(&a)[lane]);
}
template <class T, class D>
HWY_INLINE bool GetLane(const LaneMask<T, D>& a, int lane) {
  return GetLane(Select(a, Lanes<T, D>(1.0), Lanes<T, D>(0.0)), lane) > 0;
}

/// A list in memory that is aligned for every vector and begins as zeros.
template <class Item>
class AlignedList {
 public:
  explicit AlignedList(std::size_t size)
      : items_(hwy::AllocateAligned<Item>(std::max<std::size_t>(size, 1))), size_(size) {
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
#endif  // ETUDE_LANES_INL_H_
