#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <vector>

namespace etude {

/// Values of some channels over time, frames × channels; NaN: unknown.
struct ChannelTracks {
  std::size_t channels = 0;
  std::vector<double> values;

  std::size_t FrameCount() const { return channels == 0 ? 0 : values.size() / channels; }
};

/// Returns rotations (frames × joints; NaN: unknown) as channels: w, x, y, z of each joint. Of a quaternion's two signs
/// it takes the one that lies nearer to the joint's last known quaternion; a joint's first takes the one nearer to
/// `like`, the channels of other rotations at the same frame, or keeps its own if that is empty or unknown.
ChannelTracks QuaternionChannels(std::span<const glm::dquat> rotations, std::size_t joints,
                                 std::span<const double> like = {});

/// Returns positions (frames × joints) as channels: x, y, z of each joint, minus `means`, divided by `deviations`, both
/// of one frame's joints.
ChannelTracks StandardisedChannels(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> means,
                                   std::span<const glm::dvec3> deviations);

/// Returns the mean over frames of the length of the difference of all channels together, as LAFAN1's code computes
/// L2Q (of QuaternionChannels) and L2P (of StandardisedChannels). Frames with an unknown value are left out. Nothing if
/// no frame is left.
std::optional<double> MeanChannelDistance(const ChannelTracks& found, const ChannelTracks& truth);

/// What NPSS takes as the power of a Fourier coefficient.
enum class PowerOf {
  kMagnitude,  ///< its squared magnitude, as Gopalakrishnan et al. 2019 define it
  kRealPart,   ///< its squared real part, as LAFAN1's code computes it
};

/// NPSS of some windows, and the weight with which it is averaged with other windows': the truth's total power.
struct PowerSpectrumError {
  double value = 0;
  double power = 0;
};

/// Returns NPSS (normalised power spectrum similarity) over successive windows of `length` frames, beginning with the
/// first frame. For each window and channel, the cumulated shares of power of found and truth are compared: Σ over
/// frequencies of their absolute difference. The result is the mean of these, weighted by the truth's power. Frames
/// after the last whole window, and windows with an unknown value, are left out. A channel without power in the truth
/// has no weight; if it has no power in `found`, found's shares are zero. Nothing if no window is left or the truth has
/// no power. Cost: windows × channels × length².
std::optional<PowerSpectrumError> MeasurePowerSpectrum(const ChannelTracks& found, const ChannelTracks& truth,
                                                       std::size_t length, PowerOf kind);

}  // namespace etude
