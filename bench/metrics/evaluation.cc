#include "bench/metrics/evaluation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "bench/metrics/alignment.h"
#include "engine/base/angles.h"
#include "engine/base/directions.h"

namespace etude {
namespace {

constexpr double kUnseen = std::numeric_limits<double>::quiet_NaN();

bool BothSeen(const glm::dvec3& a, const glm::dvec3& b) { return !std::isnan(a.x) && !std::isnan(b.x); }

}  // namespace

std::optional<double> MeanOfSeen(std::span<const double> values) {
  // Four sums at once: one alone would wait for each addition.
  constexpr std::size_t kSums = 4;
  double sums[kSums] = {}, counts[kSums] = {};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool is_seen = !std::isnan(values[i]);
    sums[i % kSums] += is_seen ? values[i] : 0;
    counts[i % kSums] += is_seen ? 1 : 0;
  }
  const double count = counts[0] + counts[1] + counts[2] + counts[3];
  if (count == 0) return std::nullopt;
  return (sums[0] + sums[1] + sums[2] + sums[3]) / count;
}

std::optional<double> ShareBelow(std::span<const double> values, double limit_mm) {
  std::size_t below = 0, count = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    ++count;
    below += value < limit_mm ? 1 : 0;
  }
  if (count == 0) return std::nullopt;
  return static_cast<double>(below) / static_cast<double>(count);
}

std::optional<double> AucTo150(std::span<const double> values) {
  constexpr int kThresholds = 31;
  constexpr double kStep_mm = 5;
  std::size_t below = 0, count = 0;  // over all thresholds
  for (const double value : values) {
    if (std::isnan(value)) continue;
    ++count;
    // The first threshold above the value: rounding in the quotient may miss it by one.
    int first = static_cast<int>(std::min(value / kStep_mm, double{kThresholds}));
    while (first < kThresholds && first * kStep_mm <= value) ++first;
    below += static_cast<std::size_t>(kThresholds - first);
  }
  if (count == 0) return std::nullopt;
  return static_cast<double>(below) / static_cast<double>(count) / kThresholds;
}

std::optional<double> SeenShare(const EvaluatedPair& pair) {
  std::size_t shown = 0, both = 0;
  for (std::size_t i = 0; i < pair.truth.positions.size(); ++i) {
    if (std::isnan(pair.truth.positions[i].x)) continue;
    ++shown;
    both += std::isnan(pair.found.positions[i].x) ? 0 : 1;
  }
  if (shown == 0) return std::nullopt;
  return static_cast<double>(both) / static_cast<double>(shown);
}

std::optional<double> AccelerationError(const PointTracks& found, const PointTracks& truth, std::size_t left_out) {
  assert(found.positions.size() == truth.positions.size());
  std::vector<double> errors;
  errors.reserve(found.positions.size());
  const std::size_t n = found.points;
  const std::size_t end = found.positions.size() - std::min(left_out * n, found.positions.size());
  for (std::size_t i = (2 + left_out) * n; i < end; ++i) {
    const auto second = [&](const PointTracks& tracks) {
      const auto& p = tracks.positions;
      return p[i - 2 * n] - 2.0 * p[i - n] + p[i];
    };
    errors.push_back(glm::length(second(found) - second(truth)));
  }
  return MeanOfSeen(errors);
}

std::optional<double> Jitter(const PointTracks& found, double rate_hz) {
  constexpr double kPrinted = 10;
  std::vector<double> lengths;
  lengths.reserve(found.positions.size());
  const std::size_t n = found.points;
  const auto& p = found.positions;
  for (std::size_t i = 3 * n; i < p.size(); ++i) {
    lengths.push_back(glm::length(p[i] - 3.0 * p[i - n] + 3.0 * p[i - 2 * n] - p[i - 3 * n]));
  }
  const auto mean = MeanOfSeen(lengths);
  if (!mean) return std::nullopt;
  return *mean * rate_hz * rate_hz * rate_hz / kPrinted;
}

std::optional<double> RootTranslationError(const EvaluatedPair& pair) {
  const auto fit = Fit(MomentsOf(pair.found_root, pair.true_root), false);
  if (!fit) return std::nullopt;
  // The true path leads over the roots that both show.
  double length = 0, error = 0, count = 0;
  const glm::dvec3* before = nullptr;
  for (std::size_t f = 0; f < pair.found_root.size(); ++f) {
    const glm::dvec3& root = pair.true_root[f];
    if (!BothSeen(pair.found_root[f], root)) continue;
    if (before != nullptr) length += glm::distance(root, *before);
    error += glm::distance(root, fit->Apply(pair.found_root[f]));
    before = &root;
    ++count;
  }
  if (length == 0) return std::nullopt;
  constexpr double kPerCent = 100;
  return kPerCent * error / count / length;
}

std::optional<RotationChannels> RotationsOf(const EvaluatedPair& pair) {
  if (pair.found_turns.empty() || pair.true_turns.empty()) return std::nullopt;
  std::vector<glm::dquat> found = pair.found_turns, truth = pair.true_turns;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (BothSeen(pair.found.positions[i], pair.truth.positions[i])) continue;
    found[i] = truth[i] = glm::dquat(kUnseen, kUnseen, kUnseen, kUnseen);
  }
  RotationChannels channels;
  channels.truth = QuaternionChannels(truth, pair.truth.points);
  channels.found = QuaternionChannels(found, pair.found.points, channels.truth.values);
  return channels;
}

std::optional<double> BendErrorDeg(const PointTracks& found, const PointTracks& truth,
                                   std::span<const std::array<std::size_t, 3>> bends) {
  std::vector<double> errors;
  for (std::size_t f = 0; f < found.FrameCount(); ++f) {
    for (const auto& [upper, middle, lower] : bends) {
      const auto angle = [&, a = upper, b = middle, c = lower](std::span<const glm::dvec3> p) {
        const glm::dvec3 in = p[b] - p[a], out = p[c] - p[b];
        const bool has_angle = glm::dot(in, in) > 0 && glm::dot(out, out) > 0;  // false for NaN, too
        return has_angle ? Degrees(AngleBetween(in, out)) : kUnseen;
      };
      errors.push_back(std::abs(angle(found.Frame(f)) - angle(truth.Frame(f))));
    }
  }
  return MeanOfSeen(errors);
}

}  // namespace etude
