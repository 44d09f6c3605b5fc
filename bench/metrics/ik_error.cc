#include "bench/metrics/ik_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "bench/statistics/curves/curves.h"
#include "engine/base/angles.h"
#include "engine/base/order_statistics.h"

namespace etude {
namespace {

/// Returns true if the largest errors of the parts `asked` are below `goal`: position errors in centimetres, errors of
/// axes in degrees.
bool AreWithin(const IkErrorSummary& errors, const IkTargetParts& asked, double goal) {
  return (!asked.positions || errors.position_max_cm < goal) && (!asked.axes || errors.axis_max_deg < goal);
}

double ShareOfFrames(std::span<const TrackedFrame> frames, bool (*is_solved)(const TrackedFrame&)) {
  const auto solved = std::count_if(frames.begin(), frames.end(), is_solved);
  return *Share(solved, static_cast<std::int64_t>(frames.size()));
}

/// Returns the sum of the absolute third differences. They are not divided by the frame interval, because the frame
/// rate cancels in the ratio of two motions.
double TotalJerk(std::span<const std::vector<double>> frames) {
  double sum = 0;
  for (std::size_t f = 3; f < frames.size(); ++f) {
    for (std::size_t i = 0; i < frames[f].size(); ++i) {
      sum += std::abs(frames[f][i] - 3 * frames[f - 1][i] + 3 * frames[f - 2][i] - frames[f - 3][i]);
    }
  }
  return sum;
}

double CountThirdDifferences(std::span<const std::vector<double>> frames) {
  return frames.size() < 4 ? 0 : static_cast<double>((frames.size() - 3) * frames.front().size());
}

}  // namespace

IkErrorSummary SummariseIkErrors(std::span<const EffectorError> errors) {
  assert(!errors.empty());
  IkErrorSummary summary;
  for (const EffectorError& error : errors) {
    const double cm = 100 * error.position;
    const glm::dvec3& angles = error.axis_angles;
    const double degrees = Degrees((angles.x + angles.y + angles.z) / 3);
    summary.position_cm += cm;
    summary.orientation_deg += degrees;
    summary.position_max_cm = std::max(summary.position_max_cm, cm);
    summary.orientation_max_deg = std::max(summary.orientation_max_deg, degrees);
    summary.axis_max_deg = std::max({summary.axis_max_deg, Degrees(angles.x), Degrees(angles.y), Degrees(angles.z)});
  }
  summary.position_cm /= static_cast<double>(errors.size());
  summary.orientation_deg /= static_cast<double>(errors.size());
  return summary;
}

bool IsSolvedPractically(const IkErrorSummary& errors, const IkTargetParts& asked) { return AreWithin(errors, asked, 0.1); }

bool IsSolvedTightly(const IkErrorSummary& errors, const IkTargetParts& asked) { return AreWithin(errors, asked, 1e-3); }

int CountLimitViolations(std::span<const double> angles, std::span<const AngleRange> limits) {
  assert(angles.size() == limits.size());
  constexpr double kRounding = Radians(1e-6);
  int count = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (std::max(limits[i].lower - angles[i], angles[i] - limits[i].upper) > kRounding) ++count;
  }
  return count;
}

double HiddenAngleDifferenceDeg(std::span<const double> angles, std::span<const double> others) {
  assert(angles.size() == others.size() && !angles.empty());
  double sum = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double difference = std::remainder(angles[i] - others[i], 2 * kPi);
    sum += difference * difference;
  }
  return Degrees(std::sqrt(sum / static_cast<double>(angles.size())));
}

bool IsFrameSolved(const TrackedFrame& frame) { return frame.keeps_limits && IsSolvedPractically(frame.errors); }

double ShareSolvedPractically(std::span<const TrackedFrame> frames) { return ShareOfFrames(frames, IsFrameSolved); }

double ShareSolvedTightly(std::span<const TrackedFrame> frames) {
  return ShareOfFrames(frames,
                       [](const TrackedFrame& frame) { return frame.keeps_limits && IsSolvedTightly(frame.errors); });
}

FrameIterations SummariseIterations(std::span<const int> iterations) {
  assert(!iterations.empty());
  const std::vector<double> counts(iterations.begin(), iterations.end());
  const double sum = std::accumulate(counts.begin(), counts.end(), 0.0);
  return {sum / static_cast<double>(counts.size()), Quantile(counts, 0.95)};
}

std::optional<double> AngleJerkRatio(std::span<const std::vector<double>> found,
                                     std::span<const std::vector<double>> truth) {
  assert(found.size() == truth.size());
  constexpr double kRounding = 1e-9;  // radians: tolerance for the third differences of a truth that stands still
  const double true_jerk = TotalJerk(truth);
  if (true_jerk <= kRounding * CountThirdDifferences(truth)) return std::nullopt;
  return TotalJerk(found) / true_jerk;
}

}  // namespace etude
