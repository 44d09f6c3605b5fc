#include "engine/vision/person_finder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "engine/vision/components.h"
#include "engine/vision/hsi.h"

namespace etude {
namespace {

constexpr std::size_t kPixelsAtOnce = 512;

/// As `DetectChange` does: grey has the hue of pure red.
Chroma ChromaOrPureRed(Rgb8 colour) {
  constexpr int kPureRed = Chroma(Rgb8{255, 0, 0}).x;
  Chroma chroma(colour);
  chroma.x = chroma.IsGrey() ? kPureRed : chroma.x;
  return chroma;
}

}  // namespace

PersonFinder::PersonFinder(const ColourImage& background, const PersonOptions& options)
    : options_(options), background_(background) {
  if (options.segmenter != Segmenter::kHue) return;
  const double cosine = std::cos(options.change.hue_threshold);
  for (const Rgb8 colour : background.pixels) {
    const Chroma chroma = ChromaOrPureRed(colour);
    x_.push_back(static_cast<float>(chroma.x));
    y3_.push_back(static_cast<float>(3 * chroma.y));
    reach_.push_back(static_cast<float>(cosine * cosine * Dot4(chroma, chroma)));
  }
}

Mask PersonFinder::Find(const ColourImage& picture) {
  return FillHoles(LargestComponent(Detect(picture)), options_.largest_hole);
}

Mask PersonFinder::Detect(const ColourImage& picture) {
  assert(picture.width == background_.width && picture.height == background_.height);
  if (options_.segmenter == Segmenter::kHue) {
    Mask mask(picture.width, picture.height);
    CompareHues(picture, mask);
    return mask;
  }
  if (options_.segmenter == Segmenter::kRunning) {
    Mask mask(picture.width, picture.height);
    Follow(picture, mask);
    return mask;
  }
  return DetectChange(background_, picture, options_.segmenter, options_.change);
}

// In single precision. Scalar products of chromas are whole numbers below 2²⁴, so only their squares are rounded: where
// the two sides are nearer than that, the block is compared again in double precision. Comparisons are read from signs,
// which leaves no branch: the loops become vector instructions.
void PersonFinder::CompareHues(const ColourImage& picture, Mask& mask) const {
  std::array<float, kPixelsAtOnce> x, y;
  std::array<std::uint32_t, kPixelsAtOnce> signs;
  constexpr float kRounding = 1e-6F;
  constexpr int kPureRed = Chroma(Rgb8{255, 0, 0}).x;
  for (std::size_t first = 0; first < mask.pixels.size(); first += kPixelsAtOnce) {
    const std::size_t count = std::min(kPixelsAtOnce, mask.pixels.size() - first);
    const Rgb8* pixels = &picture.pixels[first];
    for (std::size_t i = 0; i < count; ++i) {
      const int r = pixels[i].r, g = pixels[i].g, b = pixels[i].b;
      const int across = g - b, along = 2 * r - g - b;
      x[i] = static_cast<float>(along + (kPureRed & -static_cast<int>((across | along) == 0)));
      y[i] = static_cast<float>(across);
    }
    const float *bx = &x_[first], *by3 = &y3_[first], *reach = &reach_[first];
    std::uint32_t closest = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const float dot = x[i] * bx[i] + y[i] * by3[i];
      const float own = x[i] * x[i] + 3.0F * y[i] * y[i];
      const float allowed = reach[i] * own, beyond = dot * dot - allowed;
      // A right angle or more (whole numbers: dot ≤ 0), or a smaller cosine than the threshold's.
      signs[i] = std::bit_cast<std::uint32_t>(dot - 0.5F) | std::bit_cast<std::uint32_t>(beyond);
      closest |= std::bit_cast<std::uint32_t>(std::abs(beyond) - kRounding * allowed);
    }
    std::uint8_t* out = &mask.pixels[first];
    for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<std::uint8_t>(signs[i] >> 31);
    closest >>= 31;
    if (closest == 0) continue;
    const double cosine = std::cos(options_.change.hue_threshold);
    for (std::size_t i = 0; i < count; ++i) {
      const Chroma b = ChromaOrPureRed(background_.pixels[first + i]), p = ChromaOrPureRed(pixels[i]);
      const double dot = Dot4(b, p);
      out[i] = (dot <= 0) | (dot * dot < cosine * cosine * Dot4(b, b) * Dot4(p, p));
    }
  }
}

void PersonFinder::Follow(const ColourImage& picture, Mask& mask) {
  const ChangeOptions& o = options_.change;
  const auto least = static_cast<float>(o.least_deviation * o.least_deviation);
  const auto most = static_cast<float>(o.running_deviations * o.running_deviations);
  const bool is_first = mean_.empty();
  if (is_first) {
    mean_.resize(3 * picture.pixels.size());
    variance_.assign(3 * picture.pixels.size(), least);
  }
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const Rgb8 pixel = picture.pixels[i];
    const std::array<float, 3> colour = {static_cast<float>(pixel.r), static_cast<float>(pixel.g),
                                         static_cast<float>(pixel.b)};
    float *mean = &mean_[3 * i], *variance = &variance_[3 * i];
    bool is_change = false;
    for (std::size_t c = 0; c < 3; ++c) {
      if (is_first) mean[c] = colour[c];
      const float off = colour[c] - mean[c];
      is_change |= off * off > most * variance[c];
    }
    const auto rate = static_cast<float>(is_change ? 0.1 * o.learning_rate : o.learning_rate);
    for (std::size_t c = 0; c < 3; ++c) {
      const float off = colour[c] - mean[c];
      mean[c] += rate * off;
      variance[c] = std::max(least, variance[c] + rate * (off * off - variance[c]));
    }
    mask.pixels[i] = is_change;
  }
}

}  // namespace etude
