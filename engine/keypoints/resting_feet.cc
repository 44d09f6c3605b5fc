#include "engine/keypoints/resting_feet.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/base/order_statistics.h"

namespace etude {
namespace {

using enum Landmark;

/// The landmarks of a foot, and their heights above the sole for a stature of 1.7 m, metres.
constexpr std::array<std::pair<std::array<Landmark, 2>, double>, kFootKinds> kFeet = {
    {{{kLeftAnkle, kRightAnkle}, 0.08},
     {{kLeftHeel, kRightHeel}, 0.03},
     {{kLeftBigToe, kRightBigToe}, 0.02},
     {{kLeftSmallToe, kRightSmallToe}, 0.02}}};

}  // namespace

double AboveSole(std::size_t kind, double stature) {
  constexpr double kOfHeights = 1.7;  // the stature to which kFeet refers
  return kFeet[kind].second / kOfHeights * stature;
}

std::vector<FootStay> FeetAtRest(std::span<const LandmarkPositions> points, double rate_hz, double stature) {
  constexpr double kMaxSpeed = 0.2, kReach = 0.025, kMaxDrift = 0.006, kShortest_s = 0.2;
  constexpr std::size_t kMaxStays = 200;
  std::vector<std::pair<std::size_t, FootStay>> found;  // the stays (periods of rest), each with its number of frames
  // Divide the path of each landmark into stays.
  for (std::size_t kind = 0; kind < kFeet.size(); ++kind) {
    for (const Landmark landmark : kFeet[kind].first) {
      std::vector<glm::dvec3> places;  // positions of the current stay so far
      const auto mean_of = [&](std::size_t from, std::size_t to) {
        glm::dvec3 sum(0);
        for (std::size_t i = from; i < to; ++i) sum += places[i];
        return sum / static_cast<double>(to - from);
      };
      // Keep a stay that is long enough and whose two halves have nearly the same mean.
      const auto end_stay = [&] {
        const std::size_t count = places.size();
        if (count >= 2 && static_cast<double>(count) >= kShortest_s * rate_hz &&
            glm::distance(mean_of(0, count / 2), mean_of(count / 2, count)) <= kMaxDrift * stature) {
          found.push_back({count, {mean_of(0, count), kind}});
        }
        places.clear();
      };
      glm::dvec3 sum(0);
      for (std::size_t i = 1; i < points.size(); ++i) {
        // A fast frame ends the stay, and so does a frame far from the stay's mean.
        const auto &before = points[i - 1][Index(landmark)], &now = points[i][Index(landmark)];
        if (!before || !now) continue;  // a gap does not end a stay
        const bool is_slow = glm::distance(*before, *now) * rate_hz <= kMaxSpeed * stature;
        const bool is_near =
            places.empty() || glm::distance(*now, sum / static_cast<double>(places.size())) <= kReach * stature;
        if (!is_slow || !is_near) end_stay();
        if (!is_slow) continue;
        sum = places.empty() ? *now : sum + *now;
        places.push_back(*now);
      }
      end_stay();
    }
  }
  // Keep the `kMaxStays` periods of rest with the most frames.
  std::ranges::stable_sort(found, std::ranges::greater{}, [](const auto& one) { return one.first; });
  if (found.size() > kMaxStays) found.resize(kMaxStays);
  std::vector<FootStay> stays;
  for (const auto& [frames, stay] : found) stays.push_back(stay);
  return stays;
}

double FloorUnder(std::span<const FootStay> stays, const glm::dvec3& up, double stature) {
  std::vector<double> floors;
  for (std::size_t kind = 0; kind < kFeet.size(); ++kind) {
    std::vector<double> heights;
    for (const FootStay& stay : stays) {
      if (stay.kind == kind) heights.push_back(glm::dot(up, stay.place));
    }
    if (heights.empty()) continue;
    const double lowest = LowerPercentile(heights, 0.1);
    std::erase_if(heights, [&](double height) { return height > lowest + 0.05 * stature; });
    double mean = 0;
    for (const double height : heights) mean += height / static_cast<double>(heights.size());
    floors.push_back(mean - AboveSole(kind, stature));
  }
  if (floors.empty()) return 0;
  const auto [low, high] = std::ranges::minmax(floors);
  return high - low > 0.025 * stature ? low : UpperMedian(floors);
}

}  // namespace etude
