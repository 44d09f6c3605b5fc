#include "engine/vision/person_finder.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/vision/components.h"
#include "engine/vision/hue_block.h"

namespace etude {
namespace {

// Colours are counted in cubic cells of the RGB cube, 8 levels wide. A cell's log-likelihood is the logarithm of its
// share of the person's pixels.
constexpr int kCells = 32, kLevels = 256 / kCells;
constexpr double kAnyColour = 0.05;     // share of the person's pixels that may have a colour not seen before
constexpr float kDecay = 0.98f;         // factor on the learnt colour counts, per picture
constexpr double kMinWornPixels = 400;  // pixels needed to learn the person's colours

// Log-likelihoods of a pixel that shows the room: unchanged, in another light, or changed.
constexpr float kAsItIs = -1, kInOtherLight = -6, kChanged = -13;
constexpr float kNoise = 4, kTint = 6;               // standard deviations, levels: in unchanged light, in other light
constexpr float kUnexplained = -10;                  // below this log-likelihood, the room does not explain the pixel
constexpr float kMinLight = 0.2f, kMaxLight = 1.3f;  // range of other light, as shares of the background's intensity
constexpr int kSameLight = 24;                       // levels; largest change of a colour by drift of the lamp

constexpr float kMaxEvidence = 6;  // limit of one pixel's log-likelihood ratio
constexpr float kFarPenalty = 3;   // subtracted from the ratio far from the person's last position
constexpr int kReach = 20;         // pixels; a person's motion from picture to picture
constexpr int kRim = 2;            // width of the person's rim in which colours mix with the room's, pixels

int CellOf(Rgb8 colour) { return (colour.r / kLevels * kCells + colour.g / kLevels) * kCells + colour.b / kLevels; }

/// Returns, for every pixel, the number of set pixels in the square of `reach` pixels in each direction.
Image<int> CountsWithin(const Mask& mask, int reach) {
  // Compute sliding sums along rows, then along columns.
  Image<int> rows(mask.width, mask.height), counts(mask.width, mask.height);
  for (int y = 0; y < mask.height; ++y) {
    int sum = 0;
    for (int x = -reach; x < mask.width; ++x) {
      if (x + reach < mask.width) sum += mask.At(x + reach, y);
      if (x - reach - 1 >= 0) sum -= mask.At(x - reach - 1, y);
      if (x >= 0) rows.At(x, y) = sum;
    }
  }
  for (int x = 0; x < mask.width; ++x) {
    int sum = 0;
    for (int y = -reach; y < mask.height; ++y) {
      if (y + reach < mask.height) sum += rows.At(x, y + reach);
      if (y - reach - 1 >= 0) sum -= rows.At(x, y - reach - 1);
      if (y >= 0) counts.At(x, y) = sum;
    }
  }
  return counts;
}

/// Smooths an image by a binomial filter of 5 × 5 pixels.
Image<float> Smoothed(const Image<float>& image) {
  constexpr std::array kWeights = {1 / 16.0f, 4 / 16.0f, 6 / 16.0f, 4 / 16.0f, 1 / 16.0f};
  Image<float> rows(image.width, image.height), out(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      float sum = 0;
      for (int i = 0; i < 5; ++i) sum += kWeights[i] * image.At(std::clamp(x + i - 2, 0, image.width - 1), y);
      rows.At(x, y) = sum;
    }
  }
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      float sum = 0;
      for (int i = 0; i < 5; ++i) sum += kWeights[i] * rows.At(x, std::clamp(y + i - 2, 0, image.height - 1));
      out.At(x, y) = sum;
    }
  }
  return out;
}

/// Returns the log-likelihood that a pixel shows the room.
float RoomAt(Rgb8 room, Rgb8 pixel) {
  // First case: the room in unchanged light, limited to `kChanged`.
  const int r = pixel.r - room.r, g = pixel.g - room.g, b = pixel.b - room.b;
  float likelihood = std::max(kChanged, kAsItIs - static_cast<float>(r * r + g * g + b * b) / (2 * kNoise * kNoise));
  // Second case: the room's colour times a factor, as in a shadow.
  const int length2 = std::max(1, room.r * room.r + room.g * room.g + room.b * room.b);
  const int dot = pixel.r * room.r + pixel.g * room.g + pixel.b * room.b;
  const int own2 = pixel.r * pixel.r + pixel.g * pixel.g + pixel.b * pixel.b;
  const float factor = static_cast<float>(dot) / static_cast<float>(length2);
  if (factor > kMinLight && factor < kMaxLight) {
    const float tint2 = std::max(0.0f, static_cast<float>(own2) - factor * static_cast<float>(dot));
    likelihood = std::max(likelihood, kInOtherLight - tint2 / (2 * kTint * kTint));
  }
  return likelihood;
}

constexpr std::size_t kPixelsAtOnce = 512;

/// Returns the chroma; grey has the hue of pure red, as in `DetectChange`.
Chroma ChromaOrPureRed(Rgb8 colour) {
  constexpr int kPureRed = Chroma(Rgb8{255, 0, 0}).x;
  Chroma chroma(colour);
  chroma.x = chroma.IsGrey() ? kPureRed : chroma.x;
  return chroma;
}

}  // namespace

ColourLikelihood::ColourLikelihood(const ColourImage& background)
    : background_(background), room_(background), worn_(kCells * kCells * kCells, 0.0f) {}

/// Estimates the gain of each channel by least squares over the pixels that probably show the same surface, and applies
/// the gains to the background.
void ColourLikelihood::LightRoomAs(const ColourImage& picture) {
  std::array<double, 3> both{}, own{};
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const Rgb8 b = background_.pixels[i], p = picture.pixels[i];
    if (MaxDifference(p, b) >= kSameLight) continue;
    both[0] += b.r * p.r, both[1] += b.g * p.g, both[2] += b.b * p.b;
    own[0] += b.r * b.r, own[1] += b.g * b.g, own[2] += b.b * b.b;
  }
  std::array<double, 3> gain;
  for (int c = 0; c < 3; ++c) gain[c] = own[c] > 0 ? both[c] / own[c] : 1;
  const auto lit = [](std::uint8_t level, double by) {
    return static_cast<std::uint8_t>(std::clamp(level * by + 0.5, 0.0, 255.0));
  };
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const Rgb8 b = background_.pixels[i];
    room_.pixels[i] = {lit(b.r, gain[0]), lit(b.g, gain[1]), lit(b.b, gain[2])};
  }
}

Image<float> ColourLikelihood::EvidenceOf(const ColourImage& picture, const Image<float>& room) const {
  Image<float> evidence(picture.width, picture.height);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const float likelier = likelihoods_[CellOf(picture.pixels[i])] - room.pixels[i];
    evidence.pixels[i] = std::clamp(likelier, -kMaxEvidence, kMaxEvidence) - (near_.pixels[i] != 0 ? 0 : kFarPenalty);
  }
  return evidence;
}

Mask ColourLikelihood::Detect(const ColourImage& picture) {
  assert(picture.width == background_.width && picture.height == background_.height);
  LightRoomAs(picture);
  Mask mask = DetectChange(room_, picture, Segmenter::kHueGated);
  Image<float> room(picture.width, picture.height);
  // Find the pixels that the room does not explain.
  strange_ = mask;
  for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
    room.pixels[i] = RoomAt(room_.pixels[i], picture.pixels[i]);
    strange_.pixels[i] &= room.pixels[i] <= kUnexplained;
  }
  // Until the person's colours are learnt, return the pixels that differ by hue; afterwards use the smoothed
  // log-likelihood ratio.
  if (likelihoods_.empty()) return mask;
  const Image<float> evidence = Smoothed(EvidenceOf(picture, room));
  for (std::size_t i = 0; i < mask.pixels.size(); ++i) mask.pixels[i] = evidence.pixels[i] > 0;
  return mask;
}

void ColourLikelihood::Learn(const ColourImage& picture, const Mask& person) {
  if (std::ranges::find(person.pixels, 1) == person.pixels.end()) return;
  // Mark the positions that the person can reach until the next picture.
  near_ = Mask(person.width, person.height);
  const Image<int> about = CountsWithin(person, kReach);
  for (std::size_t i = 0; i < near_.pixels.size(); ++i) near_.pixels[i] = about.pixels[i] > 0;

  // Count the colours of the person's pixels that the room does not explain. Leave out a rim of `kRim` pixels.
  Mask sure = person;
  for (std::size_t i = 0; i < sure.pixels.size(); ++i) sure.pixels[i] &= strange_.pixels[i];
  const Image<int> inside = CountsWithin(sure, kRim);
  constexpr int kWhole = (2 * kRim + 1) * (2 * kRim + 1);
  for (float& worn : worn_) worn *= kDecay;
  worn_sum_ *= kDecay;
  for (std::size_t i = 0; i < sure.pixels.size(); ++i) {
    if (inside.pixels[i] < kWhole) continue;
    worn_[CellOf(picture.pixels[i])] += 1;
    worn_sum_ += 1;
  }
  if (worn_sum_ >= kMinWornPixels) TellColours();
}

/// Smooths the histogram with the weights 1/4, 1/2, 1/4 along each channel, and computes the log-likelihoods.
void ColourLikelihood::TellColours() {
  std::vector<float> shares = worn_;
  for (const int step : {1, kCells, kCells * kCells}) {
    const std::vector<float> from = shares;
    for (int cell = 0; cell < static_cast<int>(from.size()); ++cell) {
      const int along = cell / step % kCells;
      const float below = along > 0 ? from[cell - step] : 0, above = along + 1 < kCells ? from[cell + step] : 0;
      shares[cell] = 0.5f * from[cell] + 0.25f * (below + above);
    }
  }
  likelihoods_.resize(shares.size());
  constexpr double kAny = kAnyColour / (kCells * kCells * kCells);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    likelihoods_[i] = static_cast<float>(std::log((1 - kAnyColour) * shares[i] / worn_sum_ + kAny));
  }
}

Mask PersonAmong(Mask changed, const PersonOptions& options) {
  if (options.pieces == PersonPieces::kLarge) {
    return FillHoles(LargeComponents(changed, options.min_piece_px, options.piece_reach), options.max_hole_px);
  }
  KeepPerson(changed, options.max_hole_px);
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

// Compares hues by SIMD. The remaining pixels, and blocks in which rounding may have decided, are compared in double
// precision.
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

// Compares each pixel with its running mean and variance, marks the changed pixels, and updates mean and variance.
void PersonFinder::Follow(const ColourImage& picture, Mask& mask) {
  const ChangeOptions& o = options_.change;
  const auto least = static_cast<float>(o.min_deviation * o.min_deviation);
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
    // A pixel has changed if any of its channels is too far from the channel's mean.
    for (std::size_t c = 0; c < 3; ++c) {
      if (is_first) mean[c] = colour[c];
      const float off = colour[c] - mean[c];
      is_change |= off * off > most * variance[c];
    }
    // Update mean and variance, ten times slower for a changed pixel.
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
