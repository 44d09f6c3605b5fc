#include "bench/metrics/beat_alignment.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

/// Returns, for each step between frames, the sum over all joints of the distance moved; nothing if a joint is not seen
/// in some frame.
std::optional<std::vector<double>> StepLengths(const PointTracks& tracks) {
  std::vector<double> lengths;
  for (std::size_t f = 0; f + 1 < tracks.FrameCount(); ++f) {
    double sum = 0;
    for (std::size_t j = 0; j < tracks.points; ++j) {
      sum += glm::distance(tracks.Frame(f)[j], tracks.Frame(f + 1)[j]);
    }
    if (std::isnan(sum)) return std::nullopt;
    lengths.push_back(sum);
  }
  return lengths;
}

/// Returns a curve smoothed by a Gaussian that is cut off at four standard deviations. The curve is mirrored beyond its
/// ends.
std::vector<double> Smoothed(const std::vector<double>& curve, double deviation) {
  const auto reach = static_cast<std::ptrdiff_t>(4 * deviation + 0.5), size = static_cast<std::ptrdiff_t>(curve.size());
  std::vector<double> weights;
  double sum = 0;
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    const auto at = static_cast<double>(k) / deviation;
    weights.push_back(std::exp(-at * at / 2));
    sum += weights.back();
  }
  // The mirror repeats the end value: … b a | a b … y z | z y …
  const auto mirrored = [&](std::ptrdiff_t at) {
    const std::ptrdiff_t within = ((at % (2 * size)) + 2 * size) % (2 * size);
    return curve[static_cast<std::size_t>(within < size ? within : 2 * size - 1 - within)];
  };
  std::vector<double> smoothed;
  for (std::ptrdiff_t i = 0; i < size; ++i) {
    double value = 0;
    for (std::ptrdiff_t k = -reach; k <= reach; ++k)
      value += weights[static_cast<std::size_t>(k + reach)] * mirrored(i + k);
    smoothed.push_back(value / sum);
  }
  return smoothed;
}

/// Returns the indices of the strict local minima: values lower than all others within `order` on either side. Beyond
/// its ends the curve continues with its end value, so an end is never a minimum.
std::vector<std::ptrdiff_t> Minima(const std::vector<double>& curve, std::ptrdiff_t order) {
  const auto last = static_cast<std::ptrdiff_t>(curve.size()) - 1;
  std::vector<std::ptrdiff_t> minima;
  for (std::ptrdiff_t i = 0; i <= last; ++i) {
    bool is_lowest = true;
    for (std::ptrdiff_t k = 1; k <= order && is_lowest; ++k) {
      const double before = curve[static_cast<std::size_t>(std::max<std::ptrdiff_t>(i - k, 0))];
      const double behind = curve[static_cast<std::size_t>(std::min(i + k, last))];
      is_lowest = curve[static_cast<std::size_t>(i)] < before && curve[static_cast<std::size_t>(i)] < behind;
    }
    if (is_lowest) minima.push_back(i);
  }
  return minima;
}

/// Returns the frames of the beats, rounded to whole frames. Beats outside the motion are left out.
std::vector<std::ptrdiff_t> FramesOf(std::span<const double> beats_s, double rate_hz, std::size_t frames) {
  std::vector<std::ptrdiff_t> found;
  for (const double beat : beats_s) {
    const double frame = std::round(beat * rate_hz);
    if (frame >= 0 && frame < static_cast<double>(frames)) found.push_back(static_cast<std::ptrdiff_t>(frame));
  }
  return found;
}

/// Returns the mean over `ours` of exp(−d² / 2σ²), where d is the distance in frames to the nearest element of
/// `others`. Returns nothing if either list is empty.
std::optional<double> MeanNearness(std::span<const std::ptrdiff_t> ours, std::span<const std::ptrdiff_t> others) {
  if (ours.empty() || others.empty()) return std::nullopt;
  constexpr double kSigma = 3;  // σ of the formula above, frames
  double sum = 0;
  for (const std::ptrdiff_t beat : ours) {
    std::ptrdiff_t nearest = std::abs(others.front() - beat);
    for (const std::ptrdiff_t other : others) nearest = std::min(nearest, std::abs(other - beat));
    const auto distance = static_cast<double>(nearest);
    sum += std::exp(-distance * distance / (2 * kSigma * kSigma));
  }
  return sum / static_cast<double>(ours.size());
}

constexpr double kSmoothing = 5;  // standard deviation of the Gaussian, frames

}  // namespace

std::vector<double> MotionBeats(const PointTracks& found, double rate_hz) {
  const auto lengths = StepLengths(found);
  if (!lengths || lengths->empty()) return {};
  std::vector<double> beats_s;
  for (const std::ptrdiff_t frame : Minima(Smoothed(*lengths, kSmoothing), 1)) {
    beats_s.push_back(static_cast<double>(frame) / rate_hz);
  }
  return beats_s;
}

std::optional<double> BeatAlignmentOfMusic(const PointTracks& found, double rate_hz, std::span<const double> beats_s) {
  const auto lengths = StepLengths(found);
  if (!lengths || lengths->empty()) return std::nullopt;
  return MeanNearness(FramesOf(beats_s, rate_hz, lengths->size()), Minima(Smoothed(*lengths, kSmoothing), 1));
}

std::optional<double> BeatAlignmentOfMotion(const PointTracks& found, double rate_hz, std::span<const double> beats_s) {
  constexpr std::ptrdiff_t kOrder = 10;  // number of frames on either side with which a minimum is compared
  const auto lengths = StepLengths(found);
  if (!lengths || lengths->empty()) return std::nullopt;
  // The speed at a frame is taken over the step before it; the first frame has speed 0.
  std::vector<double> speeds = {0};
  speeds.insert(speeds.end(), lengths->begin(), lengths->end());
  return MeanNearness(Minima(speeds, kOrder), FramesOf(beats_s, rate_hz, speeds.size()));
}

}  // namespace etude
