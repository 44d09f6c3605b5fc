#include "engine/vision/person_finder.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "engine/vision/change_detection.h"
#include "engine/vision/components.h"
#include "engine/vision/hue_block.h"

namespace etude {
namespace {

constexpr std::size_t kPixelsAtOnce = 512;

/// Returns the chroma; grey has the hue of pure red, as in `DetectChange`.
Chroma ChromaOrPureRed(Rgb8 colour) {
  constexpr int kPureRed = Chroma(Rgb8{255, 0, 0}).x;
  Chroma chroma(colour);
  chroma.x = chroma.IsGrey() ? kPureRed : chroma.x;
  return chroma;
}

}  // namespace

Mask PersonAmong(Mask changed, const PersonOptions& options) {
  if (options.pieces == PersonPieces::kLarge) {
    return FillHoles(LargeComponents(changed, options.smallest_piece, options.piece_reach), options.largest_hole);
  }
  KeepPerson(changed, options.largest_hole);
  return changed;
}

PersonFinder::PersonFinder(const ColourImage& background, const PersonOptions& options)
    : options_(options), background_(background) {
  if (options.segmenter == Segmenter::kLikelihood) colours_.emplace(background);
  if (options.segmenter != Segmenter::kHue) return;
  cosine2_ = std::cos(options.change.hue_threshold) * std::cos(options.change.hue_threshold);
  for (const Rgb8 colour : background.pixels) {
    const Chroma chroma = ChromaOrPureRed(colour);
    x_.push_back(static_cast<std::int16_t>(chroma.x));
    y_.push_back(static_cast<std::int16_t>(chroma.y));
  }
}

Mask PersonFinder::Find(const ColourImage& picture) {
  Mask person = PersonAmong(Detect(picture), options_);
  if (colours_) colours_->Learn(picture, person);
  return person;
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
  if (colours_) return colours_->Detect(picture);
  return DetectChange(background_, picture, options_.segmenter, options_.change);
}

// By vectors; what they leave over, and blocks in which rounding may have decided, in double precision.
void PersonFinder::CompareHues(const ColourImage& picture, Mask& mask) const {
  for (std::size_t first = 0; first < mask.pixels.size(); first += kPixelsAtOnce) {
    const HueBlock block{.pixels = &picture.pixels[first],
                         .background_x = &x_[first],
                         .background_y = &y_[first],
                         .count = std::min(kPixelsAtOnce, mask.pixels.size() - first)};
    std::uint8_t* out = &mask.pixels[first];
    const HueBlockResult done = CompareHueBlock(block, static_cast<float>(cosine2_), out);
    for (std::size_t i = done.is_sure ? done.compared : 0; i < block.count; ++i) {
      const Chroma b = ChromaOrPureRed(background_.pixels[first + i]), p = ChromaOrPureRed(block.pixels[i]);
      const double dot = Dot4(b, p);
      out[i] = (dot <= 0) | (dot * dot < cosine2_ * Dot4(b, b) * Dot4(p, p));
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
