#include "engine/recognition/performance_measures.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

/// One limb along a path: weighted sums over its pairs.
struct LimbSums {
  double weight = 0, gaps = 0, products = 0, seen_squares = 0, taught_squares = 0;
  glm::dvec3 seen{0}, taught{0};

  void Add(const glm::dvec3& s, const glm::dvec3& t, double w) {
    const glm::dvec3 gap = s - t;
    weight += w;
    gaps += w * glm::dot(gap, gap);
    products += w * glm::dot(s, t);
    seen_squares += w * glm::dot(s, s);
    taught_squares += w * glm::dot(t, t);
    seen += w * s;
    taught += w * t;
  }
};

/// Lengths of differences of unit vectors: 1 is 60 degrees.
struct LimbMeasures {
  double error = 0;    ///< root mean square
  double centred = 0;  ///< likewise, both about their means
  double missing = 0;  ///< share of the taught amplitude; below 0: too large
};

LimbMeasures MeasureLimb(const LimbSums& sums) {
  if (!(sums.weight > 0)) return {};
  const double w = sums.weight;
  const glm::dvec3 seen = sums.seen / w, taught = sums.taught / w;
  const double covariance = sums.products / w - glm::dot(seen, taught);
  const double seen_variance = std::max(0.0, sums.seen_squares / w - glm::dot(seen, seen));
  const double taught_variance = std::max(0.0, sums.taught_squares / w - glm::dot(taught, taught));
  constexpr double kStill = 0.02;  // a limb that is to move by less has hardly an amplitude
  return {.error = std::sqrt(sums.gaps / w),
          .centred = std::sqrt(std::max(0.0, seen_variance + taught_variance - 2 * covariance)),
          .missing = 1.0 - (covariance + kStill) / (taught_variance + kStill)};
}

/// Parts of PoseParts::kLimbs: those of the middle, then pairs.
constexpr std::array<std::size_t, 4> kMiddle = {0, 1, 2, 11};
constexpr std::array<std::array<std::size_t, 2>, 4> kPairs = {{{3, 4}, {5, 6}, {7, 8}, {9, 10}}};

/// How the clock of a performance went against the example's, seconds.
struct ClockMeasures {
  double lag = 0;       ///< mean, from the first step seen
  double stretch = 0;   ///< 0 at the taught tempo, 1 at half of it
  double unsteady = 0;  ///< root mean square about a steady tempo
};

ClockMeasures MeasureClock(std::span<const StepPair> path) {
  const double count = static_cast<double>(path.size());
  double seen = 0, taught = 0, seen_squares = 0, taught_squares = 0, products = 0;
  for (const StepPair& pair : path) {
    const double s = pair.seen / kStepsPerSecond, t = pair.taught / kStepsPerSecond;
    seen += s / count;
    taught += t / count;
    seen_squares += s * s / count;
    taught_squares += t * t / count;
    products += s * t / count;
  }
  const double covariance = products - seen * taught;
  const double taught_variance = taught_squares - taught * taught;
  const double seen_variance = seen_squares - seen * seen;
  const double tempo = taught_variance > 0 ? covariance / taught_variance : 1.0;
  return {.lag = seen - taught,
          .stretch = tempo - 1,
          .unsteady = std::sqrt(std::max(0.0, seen_variance - tempo * covariance))};
}

}  // namespace

const std::vector<std::string>& MeasureNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const char* what : {"error", "centred error", "missing amplitude"}) {
      for (const char* part : {"trunk", "shoulders", "head", "lift", "upper arm +", "upper arm -", "forearm +",
                               "forearm -", "thigh +", "thigh -", "shank +", "shank -"}) {
        list.push_back(std::string(what) + " of " + part);
      }
    }
    for (const char* other : {"distance", "worst error", "mean error", "lag", "stretch", "unsteady", "nearest other"}) {
      list.emplace_back(other);
    }
    return list;
  }();
  return names;
}

PerformanceMeasures Measure(const AlignedPerformance& performance) {
  std::array<LimbSums, kPosePartCount> sums;
  for (const StepPair& pair : performance.path) {
    const PoseVector& seen = performance.seen(pair.seen);
    const PoseVector& taught = performance.pattern[static_cast<std::size_t>(pair.taught)];
    for (std::size_t i = 0; i < kPosePartCount; ++i) sums[i].Add(seen.parts[i], taught.parts[i], seen.weights[i]);
  }
  std::array<LimbMeasures, kPosePartCount> limbs;
  for (std::size_t i = 0; i < kPosePartCount; ++i) limbs[i] = MeasureLimb(sums[i]);

  PerformanceMeasures measures{};
  std::size_t next = 0;
  for (double LimbMeasures::*what : {&LimbMeasures::error, &LimbMeasures::centred, &LimbMeasures::missing}) {
    for (std::size_t i : kMiddle) measures[next++] = limbs[i].*what;
    for (const auto& [left, right] : kPairs) {
      measures[next++] = std::max(limbs[left].*what, limbs[right].*what);
      measures[next++] = std::min(limbs[left].*what, limbs[right].*what);
    }
  }
  double worst = 0, mean = 0;
  for (const LimbMeasures& limb : limbs) {
    worst = std::max(worst, limb.error);
    mean += limb.error / kPosePartCount;
  }
  const ClockMeasures clock = MeasureClock(performance.path);
  const double both = performance.cost + performance.other_cost;
  for (double value : {std::sqrt(performance.cost), worst, mean, clock.lag, clock.stretch, clock.unsteady,
                       std::isfinite(both) && both > 0 ? performance.cost / both : 0.0}) {
    measures[next++] = value;
  }
  return measures;
}

}  // namespace etude
