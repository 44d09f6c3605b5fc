#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/fuzzy/membership.h"
#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"

namespace etude {

/// Scores how well a stream passes through the poses of a move in their order, each held for a while. A passage is a
/// choice of frames in order, one per pose; it fits as well as its worst pose, and a pose as its worst of the last
/// `hold_frames` seen frames.
class PoseSequence {
 public:
  /// Takes at least one pose and `hold_frames` ≥ 1. A passage takes at most `span_frames` ≥ 0 frames from its first
  /// pose to its last.
  PoseSequence(std::size_t poses, int hold_frames, int span_frames);

  /// Begins passages anew for `Asked`.
  void Open();
  /// Takes how well this frame matches each pose, in [0, 1]. An empty span means that no body is seen, which neither
  /// breaks nor holds a pose.
  void Update(std::span<const double> matches);

  /// Returns the score of the best passage since `Open`, however long; it never falls before the next one.
  double Asked() const { return asked_.back(); }
  /// Returns the score of the best passage within the span that ends in this frame.
  double Spotted() const { return spotted_; }

 private:
  struct Held {
    int frame;
    std::vector<double> scores;  // per pose
  };

  double BestPassageEndingIn(std::span<const double> held) const;

  std::size_t hold_frames_;
  int span_frames_;
  int frame_ = 0;
  std::size_t seen_ = 0, seen_since_open_ = 0;
  std::vector<std::vector<double>> recent_;  // per pose, the last `hold_frames` matches, a ring
  std::vector<double> asked_;                // per pose, of passages that got so far
  std::deque<Held> within_span_;             // before this frame
  double spotted_ = 0;
};

/// The rules by which a key pose counts as reached. Evidence: `scenarios/quick/detection.yaml`, an answer with a
/// sensor's errors.
struct KeyPoseOptions {
  /// The factor on every tolerance. Above 1 for a noisy sensor or free people: at 1.2 fixed weights find about what
  /// adaptive ones do.
  double tolerance_scale = 1.0;
  /// The weighted share of a pose's angles that must be within their tolerances, in (0, 1]. At 0.8 (ours) fixed weights
  /// demand every angle of a pose of up to four, as A does; adaptive ones demand every angle that is seen, and let one
  /// guessed angle of three or four be off. 0.75 forgives one angle of four. At 1 the weights decide nothing, unless
  /// one of them is 0.
  double pose_share = 0.8;
  /// The number of seen frames in a row in which a pose must be met, ≥ 1. Three (ours), 0.1 s at 30 Hz, so that a pose
  /// which noise passes through is none. Change it with the frame rate; every frame more delays each answer by one, and
  /// a quick performer does not hold a pose for long.
  int hold_frames = 3;
};

/// Returns how well this frame matches the pose, in [0, 1]: 1 / (1 + s²), s being the least factor by which all
/// tolerances must be multiplied for the wanted share of angles to be within. So ½ or more exactly where they are as
/// they stand (A's crisp rule), and a lower threshold is a wider tolerance. 0 when no angle has any weight.
double MatchOf(const FeatureFrame& frame, const TaughtPose& pose, const SightWeights& weights,
               const KeyPoseOptions& options);

/// Paper A's recogniser: the move's key poses are reached in their order. Moves must have key poses (CheckKeyPoses).
/// Its evidence passes ½ where A's crisp rule is met.
std::unique_ptr<Recogniser> MakeKeyPoseRecogniser(std::span<const TaughtMove> taught, const SightWeights& weights,
                                                  const KeyPoseOptions& options);

struct FuzzyRulesOptions {
  /// The number of seen frames in a row in which a rule must hold, as of key poses.
  int hold_frames = 3;
};

/// Returns the grade to which a frame belongs to a key pose, in [0, 1], by a rule of paper A's fuzzy system: "RH is as
/// taught AND LH is as taught AND …", AND being the minimum. A feature is as taught as far as its grades in the frame
/// and at the taught angle overlap: Σ min(μ, μ′) / Σ max(μ, μ′) over its terms. With adaptive weights, a feature that
/// counts w is held against the pose only as far as w: max(overlap, 1 − w) (Yager 1981). 0 when no feature has any
/// weight.
double RuleStrength(const FeatureFrame& frame, const TaughtPose& pose, const SightWeights& weights,
                    const Memberships& memberships);

/// Paper A's features with fuzzy rules over time (ours): one rule per key pose, and one per move, "first this pose,
/// then that, within one performance", again by the minimum. Knows table 1's terms, not the key poses' tolerances.
std::unique_ptr<Recogniser> MakeFuzzyRulesRecogniser(std::span<const TaughtMove> taught, const SightWeights& weights,
                                                     const FuzzyRulesOptions& options);

/// Finds for each of a move's key poses the first of `frames`, counted from their beginning, in which it and all poses
/// before it have been reached in their order by A's crisp rule; nothing where that never happened.
std::vector<std::optional<int>> WhenReached(std::span<const TaughtPose> poses, std::span<const FeatureFrame> frames,
                                            const SightWeights& weights, const KeyPoseOptions& options);

}  // namespace etude
