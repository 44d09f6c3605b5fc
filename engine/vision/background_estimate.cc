#include "engine/vision/background_estimate.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

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
  const auto changes = [&](std::size_t a, std::size_t b) {
    Mask changed(pictures[a].width, pictures[a].height);
    for (std::size_t i = 0; i < changed.pixels.size(); ++i) {
      changed.pixels[i] = MaxDifference(pictures[a].pixels[i], pictures[b].pixels[i]) > options.change;
    }
    return changed;
  };
  // The change from picture k to k + lag serves both pictures.
  std::vector<Mask> to_later;
  std::vector<Activity> activity;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    to_later.push_back(changes(k, std::min(k + options.lag, pictures.size() - 1)));
    Mask moved = to_later.back();
    const Mask to_earlier = k < options.lag ? changes(k, 0) : std::move(to_later[k - options.lag]);
    for (std::size_t i = 0; i < moved.pixels.size(); ++i) moved.pixels[i] |= to_earlier.pixels[i];
    activity.push_back(ShareAbout(moved, options.reach));
  }
  return activity;
}

ColourImage EstimateBackground(std::span<const ColourImage> pictures, std::span<const Activity> activity,
                               std::size_t kept) {
  assert(!pictures.empty() && activity.size() == pictures.size() && kept >= 1);
  kept = std::min(kept, pictures.size());
  ColourImage background(pictures[0].width, pictures[0].height);
  std::vector<std::size_t> quietest(kept);  // pictures by ascending activity at the pixel; of equals, the earlier first
  std::vector<float> least(kept);           // their activities
  std::vector<std::uint8_t> levels(kept);
  std::vector<const float*> activities;
  for (const Activity& one : activity) activities.push_back(one.pixels.data());
  // For each pixel: select the pictures with the lowest activity there, then take the median of each channel.
  for (std::size_t i = 0; i < background.pixels.size(); ++i) {
    for (std::size_t k = 0; k < pictures.size(); ++k) {
      const float own = activities[k][i];
      if (k >= kept && own >= least[kept - 1]) continue;
      std::size_t at = std::min(k, kept - 1);
      for (; at > 0 && own < least[at - 1]; --at) {
        least[at] = least[at - 1];
        quietest[at] = quietest[at - 1];
      }
      least[at] = own;
      quietest[at] = k;
    }
    const auto median = [&](std::uint8_t Rgb8::*colour) {
      for (std::size_t k = 0; k < kept; ++k) levels[k] = pictures[quietest[k]].pixels[i].*colour;
      const auto middle = levels.begin() + static_cast<std::ptrdiff_t>(kept / 2);
      std::nth_element(levels.begin(), middle, levels.end());
      return *middle;
    };
    background.pixels[i] = {median(&Rgb8::r), median(&Rgb8::g), median(&Rgb8::b)};
  }
  return background;
}

}  // namespace etude
