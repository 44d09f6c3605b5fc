#include "bench/metrics/tracking.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "bench/metrics/percentile.h"
#include "bench/statistics/curves/curves.h"

namespace etude {
namespace {

double ShareOfFrames(std::span<const TrackedFrame> frames, bool (*is_solved)(const TrackedFrame&)) {
  const auto solved = std::count_if(frames.begin(), frames.end(), is_solved);
  return *Share(solved, static_cast<std::int64_t>(frames.size()));
}

/// The sum of all third differences' sizes; the rate is the same for both motions that are compared.
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
  return {sum / static_cast<double>(counts.size()), Percentile95(counts)};
}

std::optional<double> AngleJerkRatio(std::span<const std::vector<double>> found,
                                     std::span<const std::vector<double>> truth) {
  assert(found.size() == truth.size());
  constexpr double kRounding = 1e-9;  // radians: third differences of a truth that stands still
  const double true_jerk = TotalJerk(truth);
  if (true_jerk <= kRounding * CountThirdDifferences(truth)) return std::nullopt;
  return TotalJerk(found) / true_jerk;
}

}  // namespace etude
