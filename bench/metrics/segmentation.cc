#include "bench/metrics/segmentation.h"

#include <cassert>
#include <cstdint>

#include "bench/metrics/share.h"

namespace etude {
namespace {

std::optional<double> MeanOf(std::span<const MaskScore> scores, std::optional<double> MaskScore::*member) {
  double sum = 0;
  int count = 0;
  for (const MaskScore& score : scores) {
    if (!(score.*member)) continue;
    sum += *(score.*member);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

std::optional<double> Percent(std::int64_t part, std::int64_t whole) {
  const auto share = Share(part, whole);
  if (!share) return std::nullopt;
  return 100 * *share;
}

}  // namespace

MaskScore ScoreMask(const Mask& found, const Mask& truth, const Mask& shadow) {
  assert(found.pixels.size() == truth.pixels.size() && found.pixels.size() == shadow.pixels.size());
  std::int64_t both = 0, found_count = 0, true_count = 0, shadow_found = 0, shadow_count = 0;
  for (std::size_t i = 0; i < found.pixels.size(); ++i) {
    // Without branches: half a million times per picture.
    const int f = found.pixels[i] != 0, t = truth.pixels[i] != 0, s = shadow.pixels[i] != 0;
    both += f & t;
    found_count += f;
    true_count += t;
    shadow_found += f & s;
    shadow_count += s;
  }
  return {.iou = Share(both, found_count + true_count - both),
          .precision = Share(both, found_count),
          .recall = Share(both, true_count),
          .f1 = Share(2 * both, found_count + true_count),
          .shadow_error = Share(shadow_found, shadow_count),
          .pwc = Percent(found_count + true_count - 2 * both, static_cast<std::int64_t>(found.pixels.size()))};
}

MaskScore MeanScore(std::span<const MaskScore> scores) {
  return {.iou = MeanOf(scores, &MaskScore::iou),
          .precision = MeanOf(scores, &MaskScore::precision),
          .recall = MeanOf(scores, &MaskScore::recall),
          .f1 = MeanOf(scores, &MaskScore::f1),
          .shadow_error = MeanOf(scores, &MaskScore::shadow_error),
          .pwc = MeanOf(scores, &MaskScore::pwc)};
}

}  // namespace etude
