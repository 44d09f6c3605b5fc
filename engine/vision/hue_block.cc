// This file is compiled once for every vector instruction set of x86-64 CPUs; the best version is chosen at run time.
// All versions compute identical bits, because MulAdd is never used.
#include "engine/vision/hue_block.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/vision/hue_block.cc"
#include "hwy/foreach_target.h"  // must come before highway.h

// This header must be included after foreach_target.h.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Wide = hn::ScalableTag<std::int16_t>;    ///< a vector of pixels
using Half = hn::Half<Wide>;                   ///< half of a vector's pixels
using Whole = hn::Rebind<std::int32_t, Half>;  ///< a full vector: one 32-bit integer per pixel of a `Half`
using Real = hn::Rebind<float, Half>;
using Byte = hn::Rebind<std::uint8_t, Wide>;

HWY_INLINE hn::Vec<Real> ToReal(hn::Vec<Half> v) { return hn::ConvertTo(Real(), hn::PromoteTo(Whole(), v)); }

/// Compares the hues of picture and background in half a vector of pixels; returns 1 in each lane in which the two hues
/// differ. Sets the lanes of `close` in which rounding may have decided.
HWY_INLINE hn::Vec<Half> Compare(hn::Vec<Half> x16, hn::Vec<Half> y16, hn::Vec<Half> bx16, hn::Vec<Half> by16,
                                 float cosine2, hn::Vec<Real>& close) {
  const Real real;
  const auto x = ToReal(x16), y = ToReal(y16), bx = ToReal(bx16), by = ToReal(by16);
  const auto y3 = hn::Mul(hn::Set(real, 3.0F), y), by3 = hn::Mul(hn::Set(real, 3.0F), by);
  const auto dot = hn::Add(hn::Mul(x, bx), hn::Mul(y3, by));
  const auto own = hn::Add(hn::Mul(x, x), hn::Mul(y3, y));
  const auto other = hn::Add(hn::Mul(bx, bx), hn::Mul(by3, by));
  const auto seen = hn::Mul(dot, dot), allowed = hn::Mul(hn::Mul(hn::Set(real, cosine2), other), own);
  // Mark the lanes in which the two sides of the comparison are equal up to rounding.
  constexpr float kRounding = 1e-6F;
  const auto near = hn::Le(hn::Abs(hn::Sub(seen, allowed)), hn::Mul(hn::Set(real, kRounding), allowed));
  close = hn::Or(close, hn::VecFromMask(real, near));
  const auto differ = hn::Or(hn::Le(dot, hn::Zero(real)), hn::Lt(seen, allowed));
  const auto ones = hn::And(hn::BitCast(Whole(), hn::VecFromMask(real, differ)), hn::Set(Whole(), 1));
  return hn::DemoteTo(Half(), ones);
}

HueBlockResult CompareBlock(const HueBlock& block, float cosine2, std::uint8_t* out) {
  const Wide wide;
  const std::size_t lanes = hn::Lanes(wide);
  const auto zero = hn::Zero(wide), red = hn::Set(wide, std::int16_t{510});  // 2R − G − B of pure red
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(block.pixels);
  auto close = hn::Zero(Real());
  std::size_t i = 0;
  for (; i + lanes <= block.count; i += lanes) {
    // Load the pixels and compute their chromas; replace grey by red.
    hn::Vec<Byte> r8, g8, b8;
    hn::LoadInterleaved3(Byte(), bytes + 3 * i, r8, g8, b8);
    const auto r = hn::PromoteTo(wide, r8), g = hn::PromoteTo(wide, g8), b = hn::PromoteTo(wide, b8);
    const auto y = hn::Sub(g, b);
    auto x = hn::Add(hn::Sub(r, g), hn::Sub(r, b));
    x = hn::IfThenElse(hn::Eq(hn::Or(x, y), zero), red, x);
    const auto bx = hn::LoadU(wide, block.background_x + i), by = hn::LoadU(wide, block.background_y + i);
    // Compare the two halves of each vector, and store the results as bytes.
    const Half half;
    const auto low = Compare(hn::LowerHalf(half, x), hn::LowerHalf(half, y), hn::LowerHalf(half, bx),
                             hn::LowerHalf(half, by), cosine2, close);
    const auto high = Compare(hn::UpperHalf(half, x), hn::UpperHalf(half, y), hn::UpperHalf(half, bx),
                              hn::UpperHalf(half, by), cosine2, close);
    hn::StoreU(hn::DemoteTo(Byte(), hn::Combine(wide, high, low)), Byte(), out + i);
  }
  return {i, hn::AllFalse(Real(), hn::MaskFromVec(close))};
}

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace etude {

HWY_EXPORT(CompareBlock);

HueBlockResult CompareHueBlock(const HueBlock& block, float cosine2, std::uint8_t* out) {
  return HWY_DYNAMIC_DISPATCH(CompareBlock)(block, cosine2, out);
}

}  // namespace etude
#endif
