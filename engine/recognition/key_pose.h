#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"
#include "engine/recognition/weighting.h"

namespace etude {

/// When a key pose counts as reached. Evidence: `scenarios/quick/detection.yaml`, an answer with a sensor's errors.
struct KeyPoseOptions {
  /// Times every tolerance. Above 1 for a noisy sensor or free people: at 1.2 fixed weights find about what adaptive
  /// ones do.
  double tolerance_scale = 1.0;
  /// The weighted share of a pose's angles that must be within their tolerances, in (0, 1]. At 0.8 (ours) fixed weights
  /// demand every angle of a pose of up to four, as A does; adaptive ones demand every angle that is seen, and let one
  /// guessed angle of three or four be off. 0.75 forgives one angle of four. At 1 the weights decide nothing, unless
  /// one of them is 0.
  double pose_share = 0.8;
  /// For how many seen frames in a row a pose must be met, ≥ 1. Three (ours), 0.1 s at 30 Hz, so that a pose which
  /// noise passes through is none. Change it with the frame rate; every frame more delays each answer by one, and a
  /// quick performer does not hold a pose for long.
  int hold_frames = 3;
};

/// How well this frame matches the pose, in [0, 1]: 1 / (1 + s²), s being the least factor by which all tolerances must
/// be multiplied for the wanted share of angles to be within. So ½ or more exactly where they are as they stand (A's
/// crisp rule), and a lower threshold is a wider tolerance. 0 when no angle has any weight.
double MatchOf(const FeatureFrame& frame, const TaughtPose& pose, const SightWeights& weights,
               const KeyPoseOptions& options);

/// Paper A's recogniser: the move's key poses are reached in their order. Moves must have key poses (CheckKeyPoses).
/// Its evidence passes ½ where A's crisp rule is met.
std::unique_ptr<Recogniser> MakeKeyPoseRecogniser(std::span<const TaughtMove> taught, const SightWeights& weights,
                                                  const KeyPoseOptions& options);

/// Finds for each of a move's key poses the first of `frames`, counted from their beginning, in which it and all poses
/// before it have been reached in their order by A's crisp rule; nothing where that never happened.
std::vector<std::optional<int>> WhenReached(std::span<const TaughtPose> poses, std::span<const FeatureFrame> frames,
                                            const SightWeights& weights, const KeyPoseOptions& options);

}  // namespace etude
