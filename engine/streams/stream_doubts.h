#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/recognition/skeleton_stream.h"
#include "engine/retargeting/up_axis.h"
#include "engine/streams/stream_maker.h"

namespace etude {

/// Returns the rule of a format that states the up axis (CSV, TRC); nullopt if the axis is estimated from the body, or
/// if the user states it (StreamOptions::up).
std::optional<UpRule> StatedUp(const StreamRecording& recording, const StreamOptions& options);

/// One text for each kind of doubt about a stream, or "".
using StreamDoubts = std::array<std::string, 4>;

/// Returns texts for users about what looks wrong with the body of a stream: the body stands along another axis than
/// the one that `up` states (FindUp, not judged without `up`); left and right joints are exchanged
/// (DescribeExchangedJoints); the feet point backwards; the body is not as tall as a person (DescribeImpossibleHeight).
/// Joints that are not tracked do not count.
StreamDoubts DoubtsOf(const SkeletonStream& stream, const std::optional<UpRule>& up);

/// Finds the doubts about a live stream: judges it when it has shown a body for 1, 2, 4, … 32 s.
class LiveDoubts {
 public:
  /// `up` is the result of StatedUp; `rate_hz` is the stream's rate.
  LiveDoubts(std::optional<UpRule> up, double rate_hz);

  /// Takes the next frames, and judges also if the stream ends with them. Returns the new doubts, each kind once.
  std::vector<std::string> Take(std::span<const SensedFrame> frames, bool at_end = false);

 private:
  std::optional<UpRule> up_;
  SkeletonStream shown_;   // the frames with a body so far, and one for each gap
  std::size_t judged_at_;  // the number of frames at which the stream is judged next
  std::array<bool, std::tuple_size_v<StreamDoubts>> is_said_{};
};

}  // namespace etude
