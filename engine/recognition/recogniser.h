#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// The rule that weights an angle by the tracking state of its joints.
enum class Weighting {
  kFixed,     ///< every angle has weight 1, as in paper A
  kAdaptive,  ///< the weight depends on the worst tracking state of the angle's joints (ours)
};

struct TrackingWeights {
  /// Default: fixed, as in paper A. Use adaptive if missing a right performance costs more than accepting a wrong one,
  /// especially if the body hides its far side from the sensor. Adaptive weights also ignore mistakes in joints that
  /// are not seen.
  Weighting weighting = Weighting::kFixed;
  /// The adaptive weight of an angle with an inferred joint, in [0, 1]; an angle whose joints are all tracked has
  /// weight 1. At 0.3 (ours) three inferred angles cannot outvote a tracked one. Raise it for a sensor whose inferred
  /// joints are accurate; at 1, inferred joints count like tracked ones.
  double inferred_weight = 0.3;
  /// The adaptive weight of an angle with a joint that is not tracked, in [0, 1]. The default is 0 because a joint that
  /// is not tracked has its position from an earlier frame. Raise it only for a sensor that still measures joints it
  /// reports as not tracked.
  double not_tracked_weight = 0.0;

  /// Returns the weight of an angle; `state` is the worst tracking state of the angle's joints.
  double Of(TrackingState state) const {
    if (weighting == Weighting::kFixed || state == TrackingState::kTracked) return 1.0;
    return state == TrackingState::kInferred ? inferred_weight : not_tracked_weight;
  }
};

/// One frame as recognisers see it: the filtered skeleton and its features.
struct SeenFrame {
  const SensedFrame& skeleton;
  const FeatureFrame& features;
};

/// A recogniser's evidence in one frame, computed from this frame and the frames before it.
struct Evidence {
  /// The evidence so far in this window that the performance asked for is right, in [0, 1]. It never decreases within a
  /// window, and is 0 if no move is asked for.
  double asked = 0;
  /// For each taught move, the evidence that a right performance of it ends in this frame, in [0, 1], whether the move
  /// was asked for or not. The span is valid until the next call.
  std::span<const double> spotted;
};

/// Follows one stream frame by frame for all taught moves at once.
class MoveFollower {
 public:
  virtual ~MoveFollower() = default;
  /// Opens a window, that is, asks for the taught move with index `move` from the next frame on; earlier frames do not
  /// count. A call without a value closes the window.
  virtual void Ask(std::optional<std::size_t> move) = 0;
  /// Takes the next frame and returns its evidence.
  virtual Evidence Update(const SeenFrame& frame) = 0;
  /// Compares the whole stream so far, as one performance, with the taught moves and returns the most similar move. Use
  /// this function if you know where performances begin and end. Returns nullopt if this follower can only judge
  /// passages within a stream.
  virtual std::optional<std::size_t> Whole() const { return std::nullopt; }
};

/// A recogniser with its taught moves. It is immutable and can follow any number of streams.
class Recogniser {
 public:
  virtual ~Recogniser() = default;
  /// Creates a follower for a stream at `rate_hz` > 0. The recogniser must outlive the follower.
  virtual std::unique_ptr<MoveFollower> Follow(double rate_hz) const = 0;
};

/// A recogniser whose followers are made by the function object `Make` from the frame rate. The object owns all data
/// that its followers use.
template <typename Make>
class RecogniserOf final : public Recogniser {
 public:
  explicit RecogniserOf(Make make) : make_(std::move(make)) {}
  std::unique_ptr<MoveFollower> Follow(double rate_hz) const override { return make_(rate_hz); }

 private:
  Make make_;
};
template <typename Make>
std::unique_ptr<Recogniser> MakeRecogniser(Make make) {
  return std::make_unique<RecogniserOf<Make>>(std::move(make));
}

}  // namespace etude
