#include "engine/recognition/clock_measures.h"

#include <algorithm>
#include <cmath>

namespace etude {

ClockComparison::ClockComparison(std::span<const PoseVector> pattern) : pattern_(pattern) {}

void ClockComparison::Update(const PoseVector& seen) {
  const int now = count_++, size = static_cast<int>(pattern_.size());
  for (int shift = -kMostSteps; shift <= kMostSteps; ++shift) {
    const int taught = now - shift;
    if (taught < 0 || taught >= size) continue;
    Sum& sum = halves_[2 * taught < size ? 0 : 1][static_cast<std::size_t>(shift + kMostSteps)];
    sum.distance += SquaredDistance(seen, pattern_[static_cast<std::size_t>(taught)]);
    ++sum.count;
  }
}

ClockComparison::Sum ClockComparison::SumOf(Part part, int shift) const {
  const auto index = static_cast<std::size_t>(shift + kMostSteps);
  if (part == Part::kFirst) return halves_[0][index];
  if (part == Part::kSecond) return halves_[1][index];
  return halves_[0][index] + halves_[1][index];
}

ClockComparison::Fit ClockComparison::FitOf(Part part, double usual_s) const {
  constexpr double kLeastShare = 0.6;   // of the part: what is seen of less tells nothing
  constexpr double kPerSecond2 = 0.02;  // of two shifts that fit alike the nearer to the usual one
  const double usual = std::clamp(usual_s * kStepsPerSecond, -1.0 * kMostSteps, 1.0 * kMostSteps);
  const double length = static_cast<double>(pattern_.size()) * (part == Part::kWhole ? 1 : 0.5);
  Fit fit{.shift_s = usual / kStepsPerSecond};
  double best = -1, best_cost = 0, at_usual = -1;
  for (int shift = -kMostSteps; shift <= kMostSteps; ++shift) {
    const Sum sum = SumOf(part, shift);
    if (sum.count < kLeastShare * length) continue;
    const double mean = sum.distance / sum.count, away_s = (shift - usual) / kStepsPerSecond;
    if (std::abs(shift - usual) <= 0.5 && at_usual < 0) at_usual = mean;
    const double cost = mean + kPerSecond2 * away_s * away_s;
    if (best >= 0 && cost >= best_cost) continue;
    best = mean;
    best_cost = cost;
    fit.shift_s = shift / kStepsPerSecond;
  }
  if (at_usual < 0) return fit;  // too little was seen
  fit.off = std::sqrt(at_usual);
  fit.gain = fit.off - std::sqrt(std::min(best, at_usual));
  return fit;
}

ClockMeasures ClockComparison::Measure(double usual_s) const {
  const Fit whole = FitOf(Part::kWhole, usual_s), first = FitOf(Part::kFirst, usual_s),
            second = FitOf(Part::kSecond, usual_s);
  return {.shift = whole.shift_s,
          .first = first.shift_s,
          .second = second.shift_s,
          .drift = second.shift_s - first.shift_s,
          .off = whole.off,
          .gain = whole.gain,
          .first_gain = first.gain,
          .second_gain = second.gain};
}

}  // namespace etude
