#pragma once

#include <array>
#include <cstdint>

#include "engine/base/image.h"

namespace etude {

/// The light on one pixel, linear: 1 is the brightest that a picture can show. Four numbers, so that a pixel is one
/// vector of the oldest machine we run on.
struct alignas(16) Light {
  float r = 0, g = 0, b = 0, unused = 0;
};
using LightImage = Image<Light>;

/// Returns the linear light of each of the 256 values of an sRGB picture.
const std::array<float, 256>& LightOfCodes();

/// The sRGB value of linear light, by a table of 2^14 steps: within 0.11 of a count of the exact curve before it is
/// rounded (in the dark, where the curve is steepest), and for each of LightOfCodes() that very code.
class CodeTable {
 public:
  static const CodeTable& Get();
  std::uint8_t operator()(float light) const { return At(StepOf(light)); }

  /// Returns the step of the table. This is the first of the conversion's two parts, which can be done for many values
  /// at once.
  static std::int32_t StepOf(float light) {
    const float above = light > 0 ? light : 0;
    const float inside = above < 1 ? above : 1;
    // Never negative; std::lround would be done for one at a time.  NOLINTNEXTLINE(bugprone-incorrect-roundings)
    return static_cast<std::int32_t>(inside * (kSteps - 1) + 0.5f);
  }
  std::uint8_t At(std::int32_t step) const { return codes_[static_cast<std::size_t>(step)]; }

 private:
  CodeTable();
  static constexpr int kSteps = 1 << 14;
  std::array<std::uint8_t, kSteps> codes_;
};

/// Writes rows of pixels, all of one length.
void DecodeRow(const Rgb8* codes, int pixels, Light* out);
void EncodeRow(const Light* light, int pixels, Rgb8* out);
/// Adds share · light to a row.
void AddDecodedRow(const Rgb8* codes, int pixels, float share, Light* out);

}  // namespace etude
