#pragma once

#include <memory>
#include <optional>
#include <span>

#include "engine/recognition/features_seen.h"
#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// One frame as recognisers see it: the filtered skeleton and the features read off it.
struct SeenFrame {
  const SensedFrame& skeleton;
  const FeatureFrame& features;
};

/// What a recogniser makes of one frame, causally: of this frame and those before it.
struct Evidence {
  /// How right the performance asked for looks so far in its window, in [0, 1]; never falls while the same one is asked
  /// for. 0 when nothing is.
  double asked = 0;
  /// Per taught move, in [0, 1]: how much this frame looks like the end of a right performance of it, asked for or not.
  /// Valid until the next call.
  std::span<const double> spotted;
};

/// Follows one stream, frame by frame, for all taught moves at once.
class MoveFollower {
 public:
  virtual ~MoveFollower() = default;
  /// From the next frame on the person is asked for this taught move (its index): the window opens, what was seen
  /// before does not count. Nothing: the window closes.
  virtual void Ask(std::optional<std::size_t> move) = 0;
  virtual Evidence Update(const SeenFrame& frame) = 0;
};

/// A recogniser that was taught its moves: constant from then on, and shared by all streams it follows.
class Recogniser {
 public:
  virtual ~Recogniser() = default;
  /// The recogniser must outlive the follower. `rate_hz` > 0.
  virtual std::unique_ptr<MoveFollower> Follow(double rate_hz) const = 0;
};

}  // namespace etude
