#include "engine/vision/background_estimate.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "engine/vision/change_detection.h"

namespace etude {
namespace {

/// Returns, for every pixel, the share of set pixels in the square around that pixel. The square is clipped to the
/// picture. Uses a summed-area table.
Activity ShareAbout(const Mask& mask, int reach) {
  const auto stride = static_cast<std::size_t>(mask.width) + 1;
  std::vector<int> sums(stride * (static_cast<std::size_t>(mask.height) + 1));
  const auto sum = [&](int x, int y) -> int& { return sums[static_cast<std::size_t>(y) * stride + x]; };
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      sum(x + 1, y + 1) = sum(x, y + 1) + sum(x + 1, y) - sum(x, y) + mask.At(x, y);
    }
  }
  Activity share(mask.width, mask.height);
  for (int y = 0; y < mask.height; ++y) {
    const int top = std::max(y - reach, 0), bottom = std::min(y + reach + 1, mask.height);
    for (int x = 0; x < mask.width; ++x) {
      const int left = std::max(x - reach, 0), right = std::min(x + reach + 1, mask.width);
      const int set = sum(right, bottom) - sum(left, bottom) - sum(right, top) + sum(left, top);
      share.At(x, y) = static_cast<float>(set) / static_cast<float>((right - left) * (bottom - top));
    }
  }
  return share;
}

}  // namespace

std::vector<Activity> MotionActivity(std::span<const ColourImage> pictures, const MotionOptions& options) {
  std::vector<Activity> activity;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    const ColourImage& now = pictures[k];
    const ColourImage& before = pictures[k < options.lag ? 0 : k - options.lag];
    const ColourImage& after = pictures[std::min(k + options.lag, pictures.size() - 1)];
    Mask moved(now.width, now.height);
    for (std::size_t i = 0; i < moved.pixels.size(); ++i) {
      moved.pixels[i] = MaxDifference(now.pixels[i], before.pixels[i]) > options.change ||
                        MaxDifference(now.pixels[i], after.pixels[i]) > options.change;
    }
    activity.push_back(ShareAbout(moved, options.reach));
  }
  return activity;
}

ColourImage EstimateBackground(std::span<const ColourImage> pictures, std::span<const Activity> activity,
                               std::size_t kept) {
  assert(!pictures.empty() && activity.size() == pictures.size() && kept >= 1);
  kept = std::min(kept, pictures.size());
  ColourImage background(pictures[0].width, pictures[0].height);
  std::vector<std::size_t> by_activity(pictures.size());
  std::vector<std::uint8_t> levels(kept);
  // For each pixel: select the pictures with the lowest activity there, then take the median of each channel.
  for (std::size_t i = 0; i < background.pixels.size(); ++i) {
    for (std::size_t k = 0; k < by_activity.size(); ++k) by_activity[k] = k;
    const auto last = by_activity.begin() + static_cast<std::ptrdiff_t>(kept) - 1;
    std::nth_element(by_activity.begin(), last, by_activity.end(), [&](std::size_t a, std::size_t b) {
      const float first = activity[a].pixels[i], second = activity[b].pixels[i];
      return first != second ? first < second : a < b;
    });
    const auto median = [&](std::uint8_t Rgb8::*colour) {
      for (std::size_t k = 0; k < kept; ++k) levels[k] = pictures[by_activity[k]].pixels[i].*colour;
      const auto middle = levels.begin() + static_cast<std::ptrdiff_t>(kept / 2);
      std::nth_element(levels.begin(), middle, levels.end());
      return *middle;
    };
    background.pixels[i] = {median(&Rgb8::r), median(&Rgb8::g), median(&Rgb8::b)};
  }
  return background;
}

}  // namespace etude
