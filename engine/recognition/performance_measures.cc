#include "engine/recognition/performance_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/order_statistics.h"

namespace etude {

ClockComparison::ClockComparison(std::span<const PoseVector> pattern) : pattern_(pattern) {}

void ClockComparison::Update(const PoseVector& seen) {
  const int now = count_++, size = static_cast<int>(pattern_.size());
  for (int shift = -kMaxSteps; shift <= kMaxSteps; ++shift) {
    const int taught = now - shift;
    if (taught < 0 || taught >= size) continue;
    ShiftSum& sum = halves_[2 * taught < size ? 0 : 1][static_cast<std::size_t>(shift + kMaxSteps)];
    sum.distance += SquaredDistance(seen, pattern_[static_cast<std::size_t>(taught)]);
    ++sum.count;
  }
}

ClockComparison::ShiftSum ClockComparison::SumOf(Part part, int shift) const {
  const auto index = static_cast<std::size_t>(shift + kMaxSteps);
  if (part == Part::kFirst) return halves_[0][index];
  if (part == Part::kSecond) return halves_[1][index];
  return halves_[0][index] + halves_[1][index];
}

ClockComparison::Fit ClockComparison::FitOf(Part part, double usual_s) const {
  constexpr double kMinShare = 0.6;     // a shift counts only if this share of the part's steps overlaps seen steps
  constexpr double kPerSecond2 = 0.02;  // penalty on the squared distance from the usual shift, to break ties
  const double usual = std::clamp(usual_s * kStepsPerSecond, -1.0 * kMaxSteps, 1.0 * kMaxSteps);
  const double length = static_cast<double>(pattern_.size()) * (part == Part::kWhole ? 1 : 0.5);
  Fit fit{.shift_s = usual / kStepsPerSecond};
  // Find the best shift, and the mean squared distance at the usual shift.
  double best = -1, best_cost = 0, at_usual = -1;
  for (int shift = -kMaxSteps; shift <= kMaxSteps; ++shift) {
    const ShiftSum sum = SumOf(part, shift);
    if (sum.count < kMinShare * length) continue;
    const double mean = sum.distance / sum.count, away_s = (shift - usual) / kStepsPerSecond;
    if (std::abs(shift - usual) <= 0.5 && at_usual < 0) at_usual = mean;
    const double cost = mean + kPerSecond2 * away_s * away_s;
    if (best >= 0 && cost >= best_cost) continue;
    best = mean;
    best_cost = cost;
    fit.shift_s = shift / kStepsPerSecond;
  }
  if (at_usual < 0) return fit;  // too few steps were seen
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

namespace {

/// Weighted sums, for one limb, over the pairs of seen and taught steps along a path.
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

struct Mean {
  double sum = 0;
  int count = 0;

  void Add(double value) {
    sum += value;
    ++count;
  }
  double Root() const { return count > 0 ? std::sqrt(sum / count) : 0.0; }
};

/// Measures of one limb, as lengths of differences of unit vectors: 1 corresponds to 60 degrees.
struct LimbMeasures {
  double error = 0;    ///< root mean square difference
  double centred = 0;  ///< root mean square difference after the means of seen and taught are subtracted
  double missing = 0;  ///< missing share of the taught amplitude; negative if the amplitude is too large
};

LimbMeasures MeasureLimb(const LimbSums& sums) {
  if (!(sums.weight > 0)) return {};
  const double w = sums.weight;
  const glm::dvec3 seen = sums.seen / w, taught = sums.taught / w;
  const double covariance = sums.products / w - glm::dot(seen, taught);
  const double seen_variance = std::max(0.0, sums.seen_squares / w - glm::dot(seen, seen));
  const double taught_variance = std::max(0.0, sums.taught_squares / w - glm::dot(taught, taught));
  constexpr double kStill = 0.02;  // moves the ratio towards 1 for a limb that hardly moves in the example
  return {.error = std::sqrt(sums.gaps / w),
          .centred = std::sqrt(std::max(0.0, seen_variance + taught_variance - 2 * covariance)),
          .missing = 1.0 - (covariance + kStill) / (taught_variance + kStill)};
}

/// Indices of parts in PoseParts::kLimbs: first the parts of the body's middle, then pairs of a left and a right part.
constexpr std::array<std::size_t, 4> kMiddle = {0, 1, 2, 11};
constexpr std::array<std::array<std::size_t, 2>, 4> kPairs = {{{3, 4}, {5, 6}, {7, 8}, {9, 10}}};

/// Writes the limbs' measures to the beginning of `measures`, and returns their number.
std::size_t PutLimbs(const std::array<LimbMeasures, kPosePartCount>& limbs, std::span<double> measures) {
  std::size_t next = 0;
  for (double LimbMeasures::*what : {&LimbMeasures::error, &LimbMeasures::centred, &LimbMeasures::missing}) {
    for (std::size_t i : kMiddle) measures[next++] = limbs[i].*what;
    for (const auto& [left, right] : kPairs) {
      measures[next++] = std::max(limbs[left].*what, limbs[right].*what);
      measures[next++] = std::min(limbs[left].*what, limbs[right].*what);
    }
  }
  return next;
}

/// The timing of a performance relative to the example, in seconds.
struct PathClock {
  double lag = 0;       ///< mean delay, counted from the first seen step
  double stretch = 0;   ///< 0 at the taught tempo, 1 at half the taught tempo
  double unsteady = 0;  ///< root mean squared deviation from a steady tempo
  double worst = 0;     ///< largest deviation from a steady tempo
};

PathClock MeasureClock(std::span<const StepPair> path) {
  const double count = static_cast<double>(path.size());
  // Compute means and second moments of seen and taught time along the path.
  double seen = 0, taught = 0, seen_squares = 0, taught_squares = 0, products = 0;
  for (const StepPair& pair : path) {
    const double s = pair.seen / kStepsPerSecond, t = pair.taught / kStepsPerSecond;
    seen += s / count;
    taught += t / count;
    seen_squares += s * s / count;
    taught_squares += t * t / count;
    products += s * t / count;
  }
  // Fit a straight line, seen time over taught time; its slope is the duration relative to the example.
  const double covariance = products - seen * taught;
  const double taught_variance = taught_squares - taught * taught;
  const double seen_variance = seen_squares - seen * seen;
  const double tempo = taught_variance > 0 ? covariance / taught_variance : 1.0;
  // Find the largest deviation from this line, that is, from a steady tempo.
  double worst = 0;
  for (const StepPair& pair : path) {
    const double beyond = (pair.seen / kStepsPerSecond - seen) - tempo * (pair.taught / kStepsPerSecond - taught);
    worst = std::max(worst, std::abs(beyond));
  }
  return {.lag = seen - taught,
          .stretch = tempo - 1,
          .unsteady = std::sqrt(std::max(0.0, seen_variance - tempo * covariance)),
          .worst = worst};
}

}  // namespace

PerformanceMeasures Measure(const AlignedPerformance& performance) {
  // Sum the errors along the path, for each limb and each third of the example.
  std::array<LimbSums, kPosePartCount> sums;
  std::array<Mean, 3> thirds;
  for (const StepPair& pair : performance.path) {
    const PoseVector& seen = performance.seen(pair.seen);
    const auto index = static_cast<std::size_t>(pair.taught);
    const PoseVector& taught = performance.pattern[index];
    thirds[3 * index / performance.pattern.size()].Add(SquaredDistance(seen, taught));
    for (std::size_t i = 0; i < kPosePartCount; ++i) sums[i].Add(seen.parts[i], taught.parts[i], seen.weights[i]);
  }
  std::array<LimbMeasures, kPosePartCount> limbs;
  for (std::size_t i = 0; i < kPosePartCount; ++i) limbs[i] = MeasureLimb(sums[i]);

  // Write the measures in the order of the slices: limbs, distances, timing of the path, nearest other move.
  PerformanceMeasures measures{};
  std::size_t next = PutLimbs(limbs, measures);
  double worst = 0, mean = 0;
  for (const LimbMeasures& limb : limbs) {
    worst = std::max(worst, limb.error);
    mean += limb.error / kPosePartCount;
  }
  const PathClock clock = MeasureClock(performance.path);
  const double both = performance.cost + performance.other_cost;
  for (double value :
       {std::sqrt(performance.cost), thirds[0].Root(), thirds[1].Root(), thirds[2].Root(), worst, mean, clock.lag,
        clock.stretch, clock.unsteady, clock.worst, std::isfinite(both) && both > 0 ? performance.cost / both : 0.0}) {
    measures[next++] = value;
  }
  return measures;
}

namespace {

/// Calls `relate(own, difference)` for every measure: `own` is the index of the measure, and `difference` the index at
/// which the measure's difference from the person's usual value is stored.
template <typename Relate>
void ForEachOwn(const Relate& relate) {
  for (const MeasureSlice& slice : {kOwnMeasures, kClockSlice, kRigidSlice}) {
    for (std::size_t i = 0; i < slice.count; ++i) relate(slice.first + i, slice.Beyond().first + i);
  }
}

}  // namespace

int RigidComparison::TaughtAt(int seen, std::size_t pace, int lag) {
  return static_cast<int>(std::lround((seen - lag) / kPaces[pace]));
}

void RigidComparison::Update(const PoseVector& seen) {
  const int now = static_cast<int>(seen_.size()), size = static_cast<int>(pattern_.size());
  // Ignore steps after the end of the pattern, even at the slowest pace and the largest lag.
  if (TaughtAt(now, kPaces.size() - 1, kLatest) >= size) return;
  seen_.push_back(seen);
  SquaredDistances(seen, pattern_, distances_);
  for (std::size_t pace = 0; pace < kPaces.size(); ++pace) {
    for (int lag = kEarliest; lag <= kLatest; ++lag) {
      const int taught = TaughtAt(now, pace, lag);
      if (taught < 0 || taught >= size) continue;
      Sum& sum = sums_[pace][static_cast<std::size_t>(lag - kEarliest)];
      sum.distance += distances_[static_cast<std::size_t>(taught)];
      ++sum.count;
    }
  }
}

std::array<double, kRigidMeasures> RigidComparison::Measure(double usual_s) const {
  constexpr double kMinShare = 0.6;  // a fit counts only if this share of the example's steps overlaps seen steps
  // Small penalties break ties in favour of the usual lag and the taught pace.
  constexpr double kPerSecond2 = 0.01, kPerLog2 = 0.1;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const int size = static_cast<int>(pattern_.size());
  std::size_t best_pace = kTaughtPace;
  int best_lag = 0;
  double best = kNone, at_taught_pace = kNone;
  // Find the lag and pace of the lowest cost.
  for (std::size_t pace = 0; pace < kPaces.size(); ++pace) {
    const double log_pace = std::log(kPaces[pace]);
    for (int lag = kEarliest; lag <= kLatest; ++lag) {
      const Sum& sum = sums_[pace][static_cast<std::size_t>(lag - kEarliest)];
      if (sum.count < kMinShare * size * kPaces[pace]) continue;
      const double away_s = lag / kStepsPerSecond - usual_s;
      const double cost = sum.distance / sum.count + kPerSecond2 * away_s * away_s + kPerLog2 * log_pace * log_pace;
      if (pace == kTaughtPace) at_taught_pace = std::min(at_taught_pace, cost);
      if (cost >= best) continue;
      best = cost;
      best_pace = pace;
      best_lag = lag;
    }
  }
  // Measure the limbs at that lag and pace.
  std::array<LimbSums, kPosePartCount> sums;
  const bool fits = best < kNone;
  for (int k = 0; fits && k < static_cast<int>(seen_.size()); ++k) {
    const int taught = TaughtAt(k, best_pace, best_lag);
    if (taught < 0 || taught >= size) continue;
    const PoseVector &seen = seen_[static_cast<std::size_t>(k)], &meant = pattern_[static_cast<std::size_t>(taught)];
    for (std::size_t i = 0; i < kPosePartCount; ++i) sums[i].Add(seen.parts[i], meant.parts[i], seen.weights[i]);
  }
  std::array<LimbMeasures, kPosePartCount> limbs;
  for (std::size_t i = 0; i < kPosePartCount; ++i) limbs[i] = MeasureLimb(sums[i]);
  std::array<double, kRigidMeasures> measures{};
  std::size_t next = PutLimbs(limbs, measures);
  const Sum& sum = sums_[best_pace][static_cast<std::size_t>(best_lag - kEarliest)];
  for (const double value :
       {best_lag / kStepsPerSecond, std::log(kPaces[best_pace]), fits ? std::sqrt(sum.distance / sum.count) : -1.0,
        at_taught_pace < kNone ? std::sqrt(at_taught_pace) : -1.0,
        fits ? sum.count / (size * kPaces[best_pace]) : 0.0}) {
    measures[next++] = value;
  }
  return measures;
}

void PersonBaseline::Add(const PerformanceMeasures& performance) {
  constexpr std::size_t kLatest = 32;
  if (latest_.size() == kLatest) latest_.erase(latest_.begin());
  latest_.push_back(performance);
  ForEachOwn([&](std::size_t own, std::size_t) {
    std::vector<double> values;
    for (const PerformanceMeasures& measures : latest_) values.push_back(measures[own]);
    usual_[own] = UpperMedian(std::move(values));
  });
}

void PersonBaseline::Relate(PerformanceMeasures& performance) const {
  if (latest_.empty()) return;
  ForEachOwn([&](std::size_t own, std::size_t beyond) { performance[beyond] = performance[own] - usual_[own]; });
}

double PersonBaseline::Shift() const {
  // If there are no earlier performances, assume that the person begins 0.1 s before the window opens (our own value).
  // A window opens one reaction time after the coach begins, and most people begin slightly earlier.
  constexpr double kUnknown = -0.1;
  return latest_.empty() ? kUnknown : usual_[kClockSlice.first];
}

}  // namespace etude
