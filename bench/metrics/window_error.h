#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <vector>

namespace etude {

/// Values of some channels over time, frames × channels. NaN: the value is unknown.
struct ChannelTracks {
  std::size_t channels = 0;
  std::vector<double> values;

  std::size_t FrameCount() const { return channels == 0 ? 0 : values.size() / channels; }
};

/// Returns rotations (frames × joints; NaN: unknown) as channels: w, x, y, z of each joint. The quaternions q and −q
/// are the same rotation; the channels contain the one that is nearer to the joint's last known quaternion. For a
/// joint's first known quaternion, they contain the one that is nearer to `like`, the channels of other rotations at
/// the same frame. If `like` is empty or unknown there, the first quaternion keeps its sign.
ChannelTracks QuaternionChannels(std::span<const glm::dquat> rotations, std::size_t joints,
                                 std::span<const double> like = {});

/// Returns positions (frames × joints) as channels: x, y, z of each joint, minus `means`, divided by `deviations`.
/// `means` and `deviations` have one entry per joint.
ChannelTracks StandardisedChannels(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> means,
                                   std::span<const glm::dvec3> deviations);

/// Returns the mean over frames of the Euclidean distance between the channels of `found` and of `truth`, as LAFAN1's
/// code computes L2Q (from QuaternionChannels) and L2P (from StandardisedChannels). Frames with an unknown value are
/// left out. Returns nothing if no frame is left.
std::optional<double> MeanChannelDistance(const ChannelTracks& found, const ChannelTracks& truth);

/// The definition of the power of a Fourier coefficient for NPSS.
enum class PowerOf {
  kMagnitude,  ///< the squared magnitude, as Gopalakrishnan et al. 2019 define it
  kRealPart,   ///< the squared real part, as LAFAN1's code computes it
};

/// The NPSS of some windows, and the weight of this value in an average with other windows: the truth's total power.
struct PowerSpectrumError {
  double value = 0;
  double power = 0;
};

/// Returns NPSS (normalised power spectrum similarity) over successive windows of `length` frames, beginning with the
/// first frame. For each window and channel, the power spectra of `found` and `truth` are divided by their totals and
/// cumulated over frequency; the absolute differences of the two curves are summed. The result is the mean of these
/// sums, weighted by the truth's power. Frames after the last complete window, and windows with an unknown value, are
/// left out. A channel without power in the truth has no weight; for a channel without power in `found`, the curve of
/// `found` is zero. Returns nothing if no window is left or the truth has no power. Cost: windows × channels × length².
std::optional<PowerSpectrumError> MeasurePowerSpectrum(const ChannelTracks& found, const ChannelTracks& truth,
                                                       std::size_t length, PowerOf kind);

}  // namespace etude
