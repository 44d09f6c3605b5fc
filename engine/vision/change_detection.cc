#include "engine/vision/change_detection.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/named.h"
#include "engine/vision/components.h"

namespace etude {

Hsi ToHsi(Rgb8 colour) {
  const double r = colour.r, g = colour.g, b = colour.b;
  const double sum = r + g + b;
  Hsi hsi;
  hsi.intensity = sum / 3;
  if (sum > 0) hsi.saturation = 1 - 3 * std::min({r, g, b}) / sum;

  const double spread = std::sqrt((r - g) * (r - g) + (r - b) * (g - b));
  if (spread == 0) return hsi;  // grey has no hue
  const double theta = std::acos(std::clamp(((r - g) + (r - b)) / 2 / spread, -1.0, 1.0));
  hsi.hue = b <= g ? theta : 2 * kPi - theta;
  return hsi;
}

namespace {

constexpr Named<Segmenter> kSegmenters[] = {
    {"rgb", Segmenter::kRgb},     {"hue", Segmenter::kHue},         {"hue-gated", Segmenter::kHueGated},
    {"ratio", Segmenter::kRatio}, {"running", Segmenter::kRunning}, {"likelihood", Segmenter::kLikelihood}};

// Decides whether two hues are more than the threshold apart, by the cosine of the angle between them.
class HueComparison {
 public:
  explicit HueComparison(double threshold) : cosine2_(std::cos(threshold) * std::cos(threshold)) {}

  bool Differ(Chroma a, Chroma b) const {
    const double dot = Dot4(a, b);
    // Thresholds are below a right angle, so their cosine is positive and the comparison may use squares.
    return (dot <= 0) | (dot * dot < cosine2_ * Dot4(a, a) * Dot4(b, b));
  }

 private:
  double cosine2_;
};

// Grey has no hue in the paper's formula; here it has hue 0, like pure red.
Chroma ChromaOrRed(Rgb8 colour) {
  constexpr int kRed = Chroma(Rgb8{255, 0, 0}).x;
  Chroma chroma(colour);
  chroma.x = chroma.IsGrey() ? kRed : chroma.x;
  return chroma;
}

/// Decides whether no change of light explains the difference of two colours: the pixel's colour is too far from every
/// multiple of the background's colour, or the nearest multiple has an implausible factor.
class ShadeComparison {
 public:
  explicit ShadeComparison(const ChangeOptions& options) : o_(options) {
    constexpr double kRounding = 1e-6;
    const double factor = std::max(0.0, std::min(1 - o_.darkest_shadow, o_.brightest_light - 1));
    alike2_ = (1 - kRounding) * o_.ratio_threshold * o_.ratio_threshold;
    alike_share2_ = (1 - kRounding) * factor * factor;
  }

  bool Differ(Rgb8 background, Rgb8 pixel) const {
    // Most pairs of colours are so alike that IsNoShade is certain to return false, so skip it for them. The factor
    // differs from 1 by at most |pixel − background| / |background|.
    const int r = pixel.r - background.r, g = pixel.g - background.g, b = pixel.b - background.b;
    const int off2 = r * r + g * g + b * b;
    const int length2 = background.r * background.r + background.g * background.g + background.b * background.b;
    if (off2 < alike2_ && off2 < alike_share2_ * length2) return false;
    return IsNoShade(background, pixel);
  }

 private:
  bool IsNoShade(Rgb8 background, Rgb8 pixel) const;

  ChangeOptions o_;
  // Two limits for the squared distance between the colours of pixel and background. Below `alike2_`, the pixel's
  // colour is certainly near enough to a multiple of the background's colour. Below `alike_share2_` times the squared
  // length of the background's colour, the factor of that multiple is certainly plausible.
  double alike2_ = 0;
  double alike_share2_ = 0;
};

bool ShadeComparison::IsNoShade(Rgb8 background, Rgb8 pixel) const {
  const double br = background.r, bg = background.g, bb = background.b;
  const double dot = pixel.r * br + pixel.g * bg + pixel.b * bb;
  const double length2 = br * br + bg * bg + bb * bb;
  const double factor = length2 > 0 ? dot / length2 : 1;
  if (factor < o_.darkest_shadow || factor > o_.brightest_light) return true;
  const double r = pixel.r - factor * br, g = pixel.g - factor * bg, b = pixel.b - factor * bb;
  return r * r + g * g + b * b > o_.ratio_threshold * o_.ratio_threshold;
}

class GatedComparison {
 public:
  explicit GatedComparison(const ChangeOptions& options) : o_(options), hues_(options.hue_threshold) {}

  bool Differ(Rgb8 background, Rgb8 pixel) const {
    const Tone b(background), p(pixel);
    const bool hue_b = HasHue(b), hue_p = HasHue(p);
    if (hue_b && hue_p && hues_.Differ(b.chroma, p.chroma)) return true;
    // If only one of the two colours has a hue, noise may be the cause, so require clearly different saturations.
    if (hue_b != hue_p && std::abs(b.Saturation() - p.Saturation()) > o_.saturation_threshold) return true;
    return p.sum < o_.darkest_shadow * b.sum || p.sum > o_.brightest_light * b.sum;
  }

 private:
  struct Tone {
    explicit Tone(Rgb8 c) : chroma(c), sum(c.r + c.g + c.b), purity(sum - 3 * std::min({c.r, c.g, c.b})) {}
    double Saturation() const { return sum > 0 ? static_cast<double>(purity) / sum : 0; }

    Chroma chroma;
    int sum;
    int purity;  // saturation · (R + G + B)
  };

  bool HasHue(const Tone& tone) const {
    return tone.purity > o_.min_saturation * tone.sum &&
           Dot4(tone.chroma, tone.chroma) > 4 * o_.min_chroma * o_.min_chroma;
  }

  ChangeOptions o_;
  HueComparison hues_;
};

}  // namespace

std::vector<std::string> SegmenterNames() { return NamesOf(kSegmenters); }

Segmenter SegmenterNamed(std::string_view name) { return ValueNamed(kSegmenters, name); }

Mask DetectChange(const ColourImage& background, const ColourImage& picture, Segmenter segmenter,
                  const ChangeOptions& options) {
  assert(background.width == picture.width && background.height == picture.height);
  assert(options.hue_threshold >= 0 && options.hue_threshold < kPi / 2);
  Mask mask(picture.width, picture.height);
  // Each segmenter is a test of two colours, the background's and the picture's. `compare` applies such a test to every
  // pixel.
  const auto compare = [&](auto differ) {
    for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
      mask.pixels[i] = differ(background.pixels[i], picture.pixels[i]);
    }
  };
  // Choose the test.
  switch (segmenter) {
    case Segmenter::kRgb:
      compare([&](Rgb8 b, Rgb8 p) { return MaxDifference(b, p) > options.rgb_threshold; });
      break;
    case Segmenter::kHue:
      compare([hues = HueComparison(options.hue_threshold)](Rgb8 b, Rgb8 p) {
        return hues.Differ(ChromaOrRed(b), ChromaOrRed(p));
      });
      break;
    case Segmenter::kHueGated:
      compare([tones = GatedComparison(options)](Rgb8 b, Rgb8 p) { return tones.Differ(b, p); });
      break;
    case Segmenter::kRatio:
      compare([shades = ShadeComparison(options)](Rgb8 b, Rgb8 p) { return shades.Differ(b, p); });
      break;
    case Segmenter::kRunning:
    case Segmenter::kLikelihood:
      assert(false && "it needs earlier pictures: use PersonFinder");
      break;
  }
  return mask;
}

Mask ExtractPerson(const ColourImage& background, const ColourImage& picture, const PersonOptions& options) {
  const Mask changed = DetectChange(background, picture, options.segmenter, options.change);
  const Mask person = options.pieces == PersonPieces::kLargest
                          ? LargestComponent(changed)
                          : LargeComponents(changed, options.min_piece_px, options.piece_reach);
  return FillHoles(person, options.max_hole_px);
}

}  // namespace etude
