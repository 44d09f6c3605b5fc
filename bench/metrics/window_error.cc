#include "bench/metrics/window_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "bench/metrics/evaluation.h"
#include "engine/base/angles.h"

namespace etude {
namespace {

/// Computes power spectra (Fourier). All windows have the same length.
class PowerSpectrum {
 public:
  PowerSpectrum(std::size_t length, PowerOf kind) : length_(length), kind_(kind) {
    for (std::size_t i = 0; i < length; ++i) {
      const double phase = 2 * kPi * static_cast<double>(i) / static_cast<double>(length);
      cosines_.push_back(std::cos(phase));
      sines_.push_back(std::sin(phase));
    }
  }

  /// Writes the power of each frequency of one channel in the window that begins at `first`, and returns the sum of the
  /// powers. If the sum is only rounding error, the sum and all powers are zero. The coefficients of real values come
  /// in conjugate pairs, so only half of them are computed.
  double Compute(const ChannelTracks& tracks, std::size_t first, std::size_t channel,
                 std::vector<double>& powers) const {
    powers.assign(length_, 0.0);
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < length_; ++i) {
      const double value = tracks.values[(first + i) * tracks.channels + channel];
      squares += value * value;
    }
    for (std::size_t k = 0; k <= length_ / 2; ++k) {
      double re = 0, im = 0;
      for (std::size_t i = 0, at = 0; i < length_; ++i, at = (at + k) % length_) {
        const double value = tracks.values[(first + i) * tracks.channels + channel];
        re += value * cosines_[at];
        if (kind_ == PowerOf::kMagnitude) im += value * sines_[at];
      }
      powers[k] = powers[(length_ - k) % length_] = re * re + im * im;
    }
    for (const double power : powers) sum += power;
    constexpr double kRounding = 1e-24;  // rounding error relative to the largest power that the values can have
    if (sum > kRounding * static_cast<double>(length_) * squares) return sum;
    powers.assign(length_, 0.0);
    return 0;
  }

 private:
  const std::size_t length_;
  const PowerOf kind_;
  std::vector<double> cosines_, sines_;
};

/// Returns Σ |cumulated share of a − cumulated share of b| over all frequencies. The shares of `a` are relative to
/// `sum_a`, the shares of `b` to `sum_b`.
double CumulatedDistance(std::span<const double> a, double sum_a, std::span<const double> b, double sum_b) {
  double of_a = 0, of_b = 0, distance = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    of_a += sum_a > 0 ? a[k] / sum_a : 0;
    of_b += b[k] / sum_b;
    distance += std::abs(of_a - of_b);
  }
  return distance;
}

bool IsKnown(const ChannelTracks& tracks, std::size_t first, std::size_t length) {
  const std::span values(&tracks.values[first * tracks.channels], length * tracks.channels);
  return std::ranges::none_of(values, [](double value) { return std::isnan(value); });
}

}  // namespace

ChannelTracks QuaternionChannels(std::span<const glm::dquat> rotations, std::size_t joints,
                                 std::span<const double> like) {
  constexpr std::size_t kParts = 4;
  ChannelTracks tracks{kParts * joints, {}};
  tracks.values.reserve(kParts * rotations.size());
  std::vector<glm::dquat> last(joints, glm::dquat(0, 0, 0, 0));  // zero until a rotation of the joint is known
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    glm::dquat q = rotations[i];
    glm::dquat& before = last[i % joints];
    double nearness = glm::dot(q, before);
    if (nearness == 0 && !like.empty()) {
      const double* model = &like[kParts * i];
      nearness = q.w * model[0] + q.x * model[1] + q.y * model[2] + q.z * model[3];
    }
    if (nearness < 0) q = -q;
    if (!std::isnan(q.w)) before = q;
    tracks.values.insert(tracks.values.end(), {q.w, q.x, q.y, q.z});
  }
  return tracks;
}

ChannelTracks StandardisedChannels(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> means,
                                   std::span<const glm::dvec3> deviations) {
  const std::size_t joints = means.size();
  assert(deviations.size() == joints && positions.size() % joints == 0);
  ChannelTracks tracks{3 * joints, {}};
  tracks.values.reserve(3 * positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const glm::dvec3 p = (positions[i] - means[i % joints]) / deviations[i % joints];
    tracks.values.insert(tracks.values.end(), {p.x, p.y, p.z});
  }
  return tracks;
}

std::optional<double> MeanChannelDistance(const ChannelTracks& found, const ChannelTracks& truth) {
  assert(found.channels == truth.channels && found.values.size() == truth.values.size());
  std::vector<double> lengths;
  for (std::size_t f = 0; f < found.FrameCount(); ++f) {
    double square = 0;
    for (std::size_t at = f * found.channels; at < (f + 1) * found.channels; ++at) {
      const double off = found.values[at] - truth.values[at];
      square += off * off;
    }
    lengths.push_back(std::sqrt(square));
  }
  return MeanOfSeen(lengths);
}

std::optional<PowerSpectrumError> MeasurePowerSpectrum(const ChannelTracks& found, const ChannelTracks& truth,
                                                       std::size_t length, PowerOf kind) {
  assert(found.channels == truth.channels && found.values.size() == truth.values.size() && length > 0);
  const PowerSpectrum spectrum(length, kind);
  std::vector<double> of_found, of_truth;
  double sum = 0, weights = 0;
  for (std::size_t first = 0; first + length <= truth.FrameCount(); first += length) {
    if (!IsKnown(found, first, length) || !IsKnown(truth, first, length)) continue;
    for (std::size_t channel = 0; channel < truth.channels; ++channel) {
      const double power = spectrum.Compute(truth, first, channel, of_truth);
      if (power <= 0) continue;
      const double found_power = spectrum.Compute(found, first, channel, of_found);
      sum += power * CumulatedDistance(of_found, found_power, of_truth, power);
      weights += power;
    }
  }
  if (weights <= 0) return std::nullopt;
  return PowerSpectrumError{sum / weights, weights};
}

}  // namespace etude
