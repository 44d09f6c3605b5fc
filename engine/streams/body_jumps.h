#pragma once

#include <optional>
#include <string>

#include "engine/streams/recording.h"

namespace etude {

/// Finds places in a recording at which the body moves farther than a person can (ours), because the sensor then shows
/// another person under the same name. The body jumps in a frame if the median of its joints' distances from the last
/// frame with a body is more than 0.5 m, and more than 12 m/s (a sprinter's speed) in the time between the two frames.
/// Two frames are compared if both have the same five joints or more.
class BodyJumps {
 public:
  /// Takes the next frame, whose positions are in metres. Times must not decrease. Returns true if the body jumps.
  bool Take(const RecordedFrame& frame);

  /// Describes the jumps for users: "the body jumps 3 times, first by 1.34 m at 2.50 s, as if another person were
  /// read"; "" if there are none. The time counts from the first frame.
  std::string Describe() const;

 private:
  std::optional<double> start_s_;
  std::optional<RecordedFrame> before_;  // the last frame with a body
  int count_ = 0;
  double first_m_ = 0, first_s_ = 0;  // length and time of the first jump
};

}  // namespace etude
