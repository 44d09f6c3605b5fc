#pragma once

#include <memory>
#include <optional>
#include <span>

#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// The weighting of angles by how well they were seen.
enum class Weighting {
  kFixed,     ///< everything 1: A's
  kAdaptive,  ///< by how well its joints are seen (ours)
};

struct SightWeights {
  /// The default is fixed, because it is A's. Adaptive where a miss costs more than praise for a mistake, most of all
  /// where the body hides its own far side: what is not seen is not counted, mistakes included.
  Weighting weighting = Weighting::kFixed;
  /// The weight of an angle with an inferred joint (adaptive weights), in [0, 1]; a tracked one counts 1. At 0.3 (ours)
  /// three guessed angles cannot outvote one that is seen. Raise it for a sensor whose guesses are good; at 1 adaptive
  /// weights are fixed ones for whatever is tracked or inferred.
  double inferred_weight = 0.3;
  /// The weight of an angle with a joint that is not tracked (adaptive weights), in [0, 1]. It is 0 because such a
  /// joint repeats where it was last. Raise it only for a sensor that goes on reporting joints it calls not tracked.
  double not_tracked_weight = 0.0;

  double Of(TrackingState state) const {
    if (weighting == Weighting::kFixed || state == TrackingState::kTracked) return 1.0;
    return state == TrackingState::kInferred ? inferred_weight : not_tracked_weight;
  }
};

/// One frame as recognisers see it: the filtered skeleton and the features read off it.
struct SeenFrame {
  const SensedFrame& skeleton;
  const FeatureFrame& features;
};

/// A recogniser's evidence in one frame, from this frame and those before it.
struct Evidence {
  /// The evidence that the performance asked for is right, so far in its window, in [0, 1]. It never falls while the
  /// same one is asked for, and is 0 when none is.
  double asked = 0;
  /// Tells for each taught move, in [0, 1], how much this frame looks like the end of a right performance of it, asked
  /// for or not. Valid until the next call.
  std::span<const double> spotted;
};

/// Follows one stream, frame by frame, for all taught moves at once.
class MoveFollower {
 public:
  virtual ~MoveFollower() = default;
  /// Opens the window of a taught move (its index), which the person is asked for from the next frame on; what was seen
  /// before does not count. Without a move, closes the window.
  virtual void Ask(std::optional<std::size_t> move) = 0;
  virtual Evidence Update(const SeenFrame& frame) = 0;
  /// Returns the taught move that all of what was seen so far looks most like as one performance, for who is told where
  /// performances begin and end; nothing: this follower knows the ends of passages only.
  virtual std::optional<std::size_t> Whole() const { return std::nullopt; }
};

/// A recogniser that was taught its moves: constant from then on, and shared by all streams it follows.
class Recogniser {
 public:
  virtual ~Recogniser() = default;
  /// The recogniser must outlive the follower. `rate_hz` > 0.
  virtual std::unique_ptr<MoveFollower> Follow(double rate_hz) const = 0;
};

}  // namespace etude
