#include "engine/vision/change_detection.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/base/named.h"
#include "engine/vision/components.h"
#include "engine/vision/hsi.h"

namespace etude {
namespace {

constexpr Named<Segmenter> kSegmenters[] = {{"hue", Segmenter::kHue}, {"hue-gated", Segmenter::kHueGated}};

// Whether two hues are more than the threshold apart, by the cosine of the angle between them.
class HueComparison {
 public:
  explicit HueComparison(double threshold) : cosine2_(std::cos(threshold) * std::cos(threshold)) {}

  bool Differ(Chroma a, Chroma b) const {
    const double dot = Dot4(a, b);
    // Thresholds are below a right angle, so their cosine is positive and may be squared.
    return dot <= 0 || dot * dot < cosine2_ * Dot4(a, a) * Dot4(b, b);
  }

 private:
  double cosine2_;
};

// The paper's formula leaves grey without a hue; as everywhere here it is then 0, that of pure red.
Chroma ChromaOrRed(Rgb8 colour) {
  const Chroma chroma(colour);
  return chroma.IsGrey() ? Chroma(Rgb8{255, 0, 0}) : chroma;
}

class GatedComparison {
 public:
  explicit GatedComparison(const ChangeOptions& options) : o_(options), hues_(options.hue_threshold) {}

  bool Differ(Rgb8 background, Rgb8 pixel) const {
    const Tone b(background), p(pixel);
    const bool hue_b = HasHue(b), hue_p = HasHue(p);
    if (hue_b && hue_p && hues_.Differ(b.chroma, p.chroma)) return true;
    // One of them near the gate must not flip on noise: the saturations have to differ clearly.
    if (hue_b != hue_p && std::abs(b.Saturation() - p.Saturation()) > o_.saturation_threshold) return true;
    return p.sum < o_.darkest_shadow * b.sum || p.sum > o_.brightest_light * b.sum;
  }

 private:
  struct Tone {
    explicit Tone(Rgb8 c) : chroma(c), sum(c.r + c.g + c.b), purity(sum - 3 * std::min({c.r, c.g, c.b})) {}
    double Saturation() const { return sum > 0 ? static_cast<double>(purity) / sum : 0; }

    Chroma chroma;
    int sum;
    int purity;  // saturation · sum
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
  if (segmenter == Segmenter::kHue) {
    const HueComparison hues(options.hue_threshold);
    for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
      mask.pixels[i] = hues.Differ(ChromaOrRed(background.pixels[i]), ChromaOrRed(picture.pixels[i]));
    }
  } else {
    const GatedComparison tones(options);
    for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
      mask.pixels[i] = tones.Differ(background.pixels[i], picture.pixels[i]);
    }
  }
  return mask;
}

Mask ExtractPerson(const ColourImage& background, const ColourImage& picture, const PersonOptions& options) {
  const Mask changed = DetectChange(background, picture, options.segmenter, options.change);
  return FillHoles(LargestComponent(changed), options.largest_hole);
}

}  // namespace etude
