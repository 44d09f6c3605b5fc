#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bench/metrics/evaluation.h"

namespace etude {
namespace {

// The columns of EvaluatedPair::feet.
enum FootColumn : std::size_t { kLeftAnkleAt, kLeftToesAt, kRightAnkleAt, kRightToesAt, kFootColumns };

constexpr double kLow_m = 0.05;

/// Returns the horizontal distance that a column's joint moves from frame `f` to the next.
double FloorStep(const PointTracks& feet, std::size_t f, std::size_t column) {
  const glm::dvec3 step = feet.Frame(f + 1)[column] - feet.Frame(f)[column];
  return std::sqrt(step.x * step.x + step.z * step.z);
}

/// Returns, for each step between frames, true if the toes skate.
std::vector<bool> Skates(const PointTracks& feet, std::size_t toes, double rate_hz) {
  constexpr double kFast_mps = 0.5;
  // The mean speed is over five steps: two before and two after a step. Steps outside the motion count as zero.
  constexpr std::ptrdiff_t kReach = 2;
  const auto steps = static_cast<std::ptrdiff_t>(feet.FrameCount()) - 1;
  std::vector<double> speeds;
  for (std::ptrdiff_t f = 0; f < steps; ++f) speeds.push_back(rate_hz * FloorStep(feet, f, toes));
  std::vector<bool> skates;
  for (std::ptrdiff_t f = 0; f < steps; ++f) {
    double mean = 0;
    for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(f - kReach, 0); k <= std::min(f + kReach, steps - 1); ++k) {
      mean += speeds[k] / (2 * kReach + 1);
    }
    const bool is_low = feet.Frame(f)[toes].y < kLow_m && feet.Frame(f + 1)[toes].y < kLow_m;
    skates.push_back(is_low && speeds[f] > kFast_mps && mean > kFast_mps);
  }
  return skates;
}

/// Returns the mean speed of the feet's joints in three dimensions, m/s, over the steps whose first frame satisfies
/// `is_judged`.
template <typename IsJudged>
double MeanSpeed(const PointTracks& feet, double rate_hz, const IsJudged& is_judged) {
  constexpr double kNoDivisionByZero = 1e-6;  // value in Kimodo's code
  double sum = 0, count = 0;
  for (std::size_t f = 0; f + 1 < feet.FrameCount(); ++f) {
    for (std::size_t column = 0; column < feet.points; ++column) {
      const double step = glm::distance(feet.Frame(f)[column], feet.Frame(f + 1)[column]);
      if (std::isnan(step) || !is_judged(f, column)) continue;
      sum += rate_hz * step;
      count += 1;
    }
  }
  return sum / (count + kNoDivisionByZero);
}

}  // namespace

std::optional<double> SkatingRatio(const PointTracks& feet, double rate_hz) {
  if (feet.points != kFootColumns || feet.FrameCount() < 2) return std::nullopt;
  const auto left = Skates(feet, kLeftToesAt, rate_hz), right = Skates(feet, kRightToesAt, rate_hz);
  std::size_t count = 0;
  for (std::size_t f = 0; f < left.size(); ++f) count += left[f] || right[f] ? 1 : 0;
  return static_cast<double>(count) / static_cast<double>(left.size());
}

std::optional<double> SkateFromHeight(const PointTracks& feet, double rate_hz) {
  if (feet.points != kFootColumns || feet.FrameCount() < 2) return std::nullopt;
  return MeanSpeed(feet, rate_hz, [&](std::size_t frame, std::size_t column) {
    return (column == kLeftToesAt || column == kRightToesAt) && feet.Frame(frame)[column].y < kLow_m;
  });
}

std::optional<double> SkateFromContacts(const PointTracks& feet, const std::vector<bool>& contacts, double rate_hz) {
  if (feet.points != kFootColumns || feet.FrameCount() < 2 || contacts.empty()) return std::nullopt;
  return MeanSpeed(feet, rate_hz,
                   [&](std::size_t frame, std::size_t column) { return contacts[frame * kFootColumns + column]; });
}

std::optional<double> ContactF1(const std::vector<bool>& found, const std::vector<bool>& truth) {
  if (found.size() != truth.size()) return std::nullopt;
  double both = 0, either = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    both += found[i] && truth[i] ? 1 : 0;
    either += (found[i] ? 1 : 0) + (truth[i] ? 1 : 0);
  }
  if (either == 0) return std::nullopt;
  return 2 * both / either;
}

std::optional<double> PhysicalFootContact(const PointTracks& feet, std::span<const glm::dvec3> root, double rate_hz) {
  if (feet.points != kFootColumns || root.size() != feet.FrameCount() || root.size() < 3) return std::nullopt;
  // Compute the length of the root's acceleration without its downward part.
  std::vector<double> accelerations;
  for (std::size_t f = 0; f + 2 < root.size(); ++f) {
    glm::dvec3 a = rate_hz * rate_hz * (root[f + 2] - 2.0 * root[f + 1] + root[f]);
    if (a.y < 0) a.y = 0;
    accelerations.push_back(glm::length(a));
  }
  double largest = 0;
  for (const double a : accelerations) largest = std::max(largest, std::isnan(a) ? 0 : a);
  constexpr double kRounding_m = 1e-7;  // of positions
  if (largest <= kRounding_m * rate_hz * rate_hz) return std::nullopt;
  // Multiply each acceleration of the root by the distances that the two feet move after the acceleration's middle
  // frame. The slower joint of a foot gives the foot's distance.
  std::vector<double> products;
  for (std::size_t f = 0; f < accelerations.size(); ++f) {
    const double left = std::min(FloorStep(feet, f + 1, kLeftAnkleAt), FloorStep(feet, f + 1, kLeftToesAt));
    const double right = std::min(FloorStep(feet, f + 1, kRightAnkleAt), FloorStep(feet, f + 1, kRightToesAt));
    const bool are_seen = !std::isnan(FloorStep(feet, f + 1, kLeftToesAt) + FloorStep(feet, f + 1, kRightToesAt));
    products.push_back(are_seen ? left * right * accelerations[f] / largest : std::nan(""));
  }
  constexpr double kPrinted = 1e4;
  const auto mean = MeanOfSeen(products);
  if (!mean) return std::nullopt;
  return kPrinted * *mean;
}

FloorErrors MeasureFloor(const PointTracks& found) {
  constexpr double kMm = 1000;
  std::vector<double> below, above;
  for (std::size_t f = 0; f < found.FrameCount(); ++f) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& p : found.Frame(f)) {
      if (p.y < lowest) lowest = p.y;  // the comparison is false if p.y is NaN
    }
    if (std::isinf(lowest)) continue;
    below.push_back(kMm * std::max(-lowest, 0.0));
    above.push_back(kMm * std::max(lowest, 0.0));
  }
  return {MeanOfSeen(below), MeanOfSeen(above)};
}

}  // namespace etude
