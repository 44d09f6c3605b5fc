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

/// Returns the mean length of `vector_at(frame, joint)` over all joints and the frames [begin, end).
template <typename VectorAt>
std::optional<double> MeanLength(std::size_t begin, std::size_t end, std::size_t joints, const VectorAt& vector_at) {
  SeenMean mean;
  std::vector<double> lengths(joints);
  for (std::size_t f = begin; f < end; ++f) {
    for (std::size_t j = 0; j < joints; ++j) lengths[j] = glm::length(vector_at(f, j));
    mean.Add(lengths);
  }
  return mean.Value();
}

}  // namespace

void SeenMean::Add(std::span<const double> values) {
  std::size_t i = 0;
  const auto add_seen = [&](std::size_t end) {
    for (; i < end; ++i, next_ = (next_ + 1) % kSums) {
      const bool is_seen = !std::isnan(values[i]);
      sums_[next_] += is_seen ? values[i] : 0;
      counts_[next_] += is_seen ? 1 : 0;
    }
  };
  add_seen(std::min((kSums - next_) % kSums, values.size()));
  // Add kSums values at a time without testing each value for NaN: a NaN makes the sum NaN, which is tested.
  const std::size_t rounds = (values.size() - i) / kSums;
  double sums[kSums];
  std::copy_n(sums_, kSums, sums);
  for (std::size_t at = i; at < i + rounds * kSums; at += kSums) {
    for (std::size_t k = 0; k < kSums; ++k) sums[k] += values[at + k];
  }
  if (!std::isnan(sums[0] + sums[1] + sums[2] + sums[3])) {
    std::copy_n(sums, kSums, sums_);
    for (double& count : counts_) count += static_cast<double>(rounds);
    i += rounds * kSums;
  }
  add_seen(values.size());
}

std::optional<double> SeenMean::Value() const {
  const double count = counts_[0] + counts_[1] + counts_[2] + counts_[3];
  if (count == 0) return std::nullopt;
  return (sums_[0] + sums_[1] + sums_[2] + sums_[3]) / count;
}

std::optional<double> MeanOfSeen(std::span<const double> values) {
  SeenMean mean;
  mean.Add(values);
  return mean.Value();
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
  std::size_t below = 0, count = 0;  // number of pairs of a value and a threshold above it; number of values
  for (const double value : values) {
    if (std::isnan(value)) continue;
    ++count;
    // Find the first threshold above the value. Rounding in the quotient may give a threshold that is one too low.
    int first = static_cast<int>(std::min(value / kStep_mm, double{kThresholds}));
    while (first < kThresholds && first * kStep_mm <= value) ++first;
    below += static_cast<std::size_t>(kThresholds - first);
  }
  if (count == 0) return std::nullopt;
  return static_cast<double>(below) / static_cast<double>(count) / kThresholds;
}

std::optional<double> SeenShare(const EvaluatedPair& pair) {
  std::size_t shown = pair.without_joint, both = 0;
  for (std::size_t i = 0; i < pair.truth.positions.size(); ++i) {
    if (std::isnan(pair.truth.positions[i].x)) continue;
    ++shown;
    both += std::isnan(pair.found.positions[i].x) ? 0 : 1;
  }
  if (shown == 0) return std::nullopt;
  return static_cast<double>(both) / static_cast<double>(shown);
}

std::optional<double> AccelerationError(const PointTracks& found, const PointTracks& truth) {
  assert(found.positions.size() == truth.positions.size());
  const std::size_t n = found.points;
  return MeanLength(2, found.FrameCount(), n,
                    [&, a = found.positions.data(), t = truth.positions.data()](auto f, auto j) {
                      const std::size_t i = f * n + j;
                      return (a[i - 2 * n] - 2.0 * a[i - n] + a[i]) - (t[i - 2 * n] - 2.0 * t[i - n] + t[i]);
                    });
}

std::optional<double> RootAccelerationError(const EvaluatedPair& pair) {
  const std::size_t n = pair.found.points, frames = pair.found.FrameCount();
  if (pair.found_root.empty() || frames == 0) return std::nullopt;
  std::vector<glm::dvec3> moves;
  for (std::size_t f = 0; f < frames; ++f) moves.push_back(pair.true_root[f] - pair.found_root[f]);
  return MeanLength(3, frames - 1, n,
                    [&, a = pair.found.positions.data(), t = pair.truth.positions.data()](auto f, auto j) {
                      const std::size_t i = f * n + j;
                      const glm::dvec3 before = a[i - 2 * n] + moves[f - 2], middle = a[i - n] + moves[f - 1];
                      return (before - 2.0 * middle + (a[i] + moves[f])) - (t[i - 2 * n] - 2.0 * t[i - n] + t[i]);
                    });
}

std::optional<double> Jitter(const PointTracks& found, double rate_hz) {
  constexpr double kPrinted = 10;
  const std::size_t n = found.points;
  const auto mean = MeanLength(3, found.FrameCount(), n, [n, p = found.positions.data()](auto f, auto j) {
    const std::size_t i = f * n + j;
    return p[i] - 3.0 * p[i - n] + 3.0 * p[i - 2 * n] - p[i - 3 * n];
  });
  if (!mean) return std::nullopt;
  return *mean * rate_hz * rate_hz * rate_hz / kPrinted;
}

std::optional<double> RootTranslationError(const EvaluatedPair& pair) {
  const auto fit = Fit(MomentsOf(pair.found_root, pair.true_root), false);
  if (!fit) return std::nullopt;
  // The true path connects the positions of the true root in the frames in which both roots are seen.
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
        const bool has_angle = glm::dot(in, in) > 0 && glm::dot(out, out) > 0;  // also false if a component is NaN
        return has_angle ? Degrees(AngleBetween(in, out)) : kUnseen;
      };
      errors.push_back(std::abs(angle(found.Frame(f)) - angle(truth.Frame(f))));
    }
  }
  return MeanOfSeen(errors);
}

}  // namespace etude
