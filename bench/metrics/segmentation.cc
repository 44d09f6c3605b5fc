#include "bench/metrics/segmentation.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "bench/statistics/curves/curves.h"

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
  // Count in runs short enough for 8-bit counters, because the compiler vectorises 8-bit counters.
  std::int64_t both = 0, found_count = 0, true_count = 0, shadow_found = 0, shadow_count = 0;
  // The largest multiple of 16 (the bytes of a SIMD register) that an 8-bit counter can hold.
  constexpr std::size_t kRun = 240;
  for (std::size_t first = 0; first < found.pixels.size(); first += kRun) {
    const std::size_t end = std::min(first + kRun, found.pixels.size());
    std::uint8_t run_both = 0, run_found = 0, run_true = 0, run_shadow_found = 0, run_shadow = 0;
    for (std::size_t i = first; i < end; ++i) {
      const std::uint8_t f = found.pixels[i] != 0, t = truth.pixels[i] != 0, s = shadow.pixels[i] != 0;
      run_both += f & t;
      run_found += f;
      run_true += t;
      run_shadow_found += f & s;
      run_shadow += s;
    }
    both += run_both;
    found_count += run_found;
    true_count += run_true;
    shadow_found += run_shadow_found;
    shadow_count += run_shadow;
  }
  // Turn the counts into shares.
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
