#pragma once

#include <array>
#include <cstdint>

#include "engine/base/image.h"

namespace etude {

/// Linear light at one pixel; 1 is the brightest value that a picture can show. The struct has four floats, because
/// four floats fill one vector register of the oldest supported processor.
struct alignas(16) Light {
  float r = 0, g = 0, b = 0, unused = 0;
};
using LightImage = Image<Light>;

/// Returns the linear light of each of the 256 values of an sRGB picture.
const std::array<float, 256>& LightOfCodes();

/// Converts linear light to sRGB codes by a table of 2^14 codes. Before rounding, the error is at most 0.11 codes (in
/// the dark, where the curve is steepest). Each value of LightOfCodes() is converted back to exactly the code that has
/// this value.
class CodeTable {
 public:
  static const CodeTable& Get();
  std::uint8_t operator()(float light) const { return At(StepOf(light)); }

  /// Returns the table's index for a value of light. This first part of the conversion can be vectorised.
  static std::int32_t StepOf(float light) {
    const float above = light > 0 ? light : 0;
    const float inside = above < 1 ? above : 1;
    // The value is never negative, and std::lround is not vectorised.  NOLINTNEXTLINE(bugprone-incorrect-roundings)
    return static_cast<std::int32_t>(inside * (kSteps - 1) + 0.5f);
  }
  std::uint8_t At(std::int32_t step) const { return codes_[static_cast<std::size_t>(step)]; }

 private:
  CodeTable();
  static constexpr int kSteps = 1 << 14;
  std::array<std::uint8_t, kSteps> codes_;
};

/// Converts a row of `pixels` pixels from sRGB codes to linear light. EncodeRow converts it back.
void DecodeRow(const Rgb8* codes, int pixels, Light* out);
void EncodeRow(const Light* light, int pixels, Rgb8* out);
/// Adds share · light of a row to `out`.
void AddDecodedRow(const Rgb8* codes, int pixels, float share, Light* out);

}  // namespace etude
