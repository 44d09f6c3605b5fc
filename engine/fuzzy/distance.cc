#include "engine/fuzzy/distance.h"

#include <cmath>

namespace etude {
namespace {

double SquaredGap(const Grades& a, const Grades& b, Feature feature) {
  double sum = 0;
  const std::size_t first = FirstTermOf(feature);
  for (std::size_t i = first; i < first + TermsOf(feature).size(); ++i) {
    const double gap = a[i] - b[i];
    sum += gap * gap;
  }
  return sum;
}

}  // namespace

PerFeature SquaredGradeGaps(const Grades& a, const Grades& b) {
  PerFeature gaps;
  for (std::size_t k = 0; k < kFeatureCount; ++k) gaps[k] = SquaredGap(a, b, AllFeatures()[k]);
  return gaps;
}

FuzzyDistance ComputeDistance(const Grades& a, const Grades& b, const FeatureWeights& weights) {
  FuzzyDistance distance;
  const PerFeature gaps = SquaredGradeGaps(a, b);
  double sum = 0;
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    distance.partials[k] = weights[k] * gaps[k];
    sum += distance.partials[k];
  }
  distance.value = std::sqrt(sum);
  return distance;
}

bool IsCloser(const Grades& a, const Grades& b, const FeatureWeights& weights, double threshold) {
  // Compare squares to avoid the root for most pairs. Rounding is monotonic: if the sum exceeds the rounded square of
  // the threshold, the rounded root of the sum is not below the threshold.
  const double square = threshold * threshold;
  double sum = 0;
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    sum += weights[k] * SquaredGap(a, b, AllFeatures()[k]);
    if (sum > square) return false;
  }
  return std::sqrt(sum) < threshold;
}

}  // namespace etude
