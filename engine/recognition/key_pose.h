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

/// Scores how well a stream passes through a move's key poses in order. A passage chooses one frame per pose, in order
/// of time. A pose's score in a frame is its worst match in the last `hold_frames` frames in which a body was seen, so
/// poses must be held. The score of a passage is the score of its worst pose.
class PoseSequence {
 public:
  /// `poses` ≥ 1 is the number of poses; `hold_frames` ≥ 1. A passage for `Spotted` lasts at most `span_frames` ≥ 0
  /// frames from its first pose to its last.
  PoseSequence(std::size_t poses, int hold_frames, int span_frames);

  /// Starts a new window, that is, the time in which the move is asked for: `Asked` counts only passages that begin
  /// after this call.
  void Open();
  /// Takes this frame's match with each pose, in [0, 1]. An empty span means that no body is seen; such a
  /// frame neither holds nor interrupts a pose.
  void Update(std::span<const double> matches);

  /// Returns the score of the best passage since `Open`, of any length. It never decreases until the next `Open`.
  double Asked() const { return asked_.back(); }
  /// Returns the score of the best passage that ends in this frame and lasts at most `span_frames`.
  double Spotted() const { return spotted_; }

 private:
  struct Held {
    int frame;
    std::vector<double> scores;
  };

  double BestPassageEndingIn(std::span<const double> held) const;

  std::size_t hold_frames_;
  int span_frames_;
  int frame_ = 0;
  std::size_t seen_ = 0, seen_since_open_ = 0;
  std::vector<std::vector<double>> recent_;  // for each pose, the last `hold_frames` matches, as a ring
  std::vector<double> asked_;                // for each pose, the score of the best passage that has reached it
  std::deque<Held> within_span_;             // scores of the earlier frames from which a passage may still begin
  double spotted_ = 0;
};

/// The rules that decide when a key pose counts as reached. `scenarios/quick/detection.yaml` shows their effect on a
/// stream with a sensor's errors.
struct KeyPoseOptions {
  /// Multiplies every tolerance. Raise it above 1 for a noisy sensor or untrained people: at 1.2, fixed weights detect
  /// about as many performances as adaptive weights.
  double tolerance_scale = 1.0;
  /// The weighted share of a pose's angles that must be within their tolerances, in (0, 1]. The default
  /// is ours. For a pose with up to four angles, 0.8 has these effects: with fixed weights, every angle must be within
  /// its tolerance, as in paper A; with adaptive weights, every tracked angle must be, and one inferred angle of three
  /// or four may be outside. At 0.75, one angle of four may be outside. At 1 the weights have no effect unless one of
  /// them is 0.
  double pose_share = 0.8;
  /// The number of consecutive seen frames in which a pose must be reached, ≥ 1. The default of three (ours), 0.1 s at
  /// 30 Hz, rejects poses that are reached by noise. Change it with the frame rate: each additional frame delays every
  /// detection by one frame, and quick performers do not hold a pose for long.
  int hold_frames = 3;
};

/// Returns how well this frame matches the pose, in [0, 1]: 1 / (1 + s²). Here s is the smallest factor by which all
/// tolerances must be multiplied until the required share of angles is within them. The result is at least ½ if and
/// only if paper A's crisp rule is fulfilled (every required angle within its tolerance). The result is 0 if no angle
/// has a positive weight.
double MatchOf(const FeatureFrame& frame, const TaughtPose& pose, const TrackingWeights& weights,
               const KeyPoseOptions& options);

/// Makes paper A's recogniser, which detects a move when its key poses are reached in order. The moves must have key
/// poses (CheckKeyPoses). The evidence reaches ½ when paper A's crisp rule is fulfilled.
std::unique_ptr<Recogniser> MakeKeyPoseRecogniser(std::span<const TaughtMove> taught, const TrackingWeights& weights,
                                                  const KeyPoseOptions& options);

struct FuzzyRulesOptions {
  /// The number of consecutive seen frames in which a rule must hold, as in KeyPoseOptions.
  int hold_frames = 3;
};

/// Returns the membership grade of a frame in a key pose, in [0, 1], by a rule of paper A's fuzzy system: "RH is as
/// taught AND LH is as taught AND …", where AND is the minimum. The grade of "as taught" is the overlap of the
/// feature's grades in the frame and at the taught angle: Σ min(μ, μ′) / Σ max(μ, μ′) over its terms. With adaptive
/// weights, a feature of weight w can lower the result to 1 − w, but not further: max(overlap, 1 − w) (Yager 1981). The
/// result is 0 if no feature has a positive weight.
double RuleStrength(const FeatureFrame& frame, const TaughtPose& pose, const TrackingWeights& weights,
                    const Memberships& memberships);

/// Makes a recogniser that applies fuzzy rules over time to paper A's features (ours). One rule per key pose gives the
/// pose's grade; one rule per move, "first this pose, then that, within one performance", combines the grades by the
/// minimum. The recogniser uses the terms of table 1 and ignores the key poses' tolerances.
std::unique_ptr<Recogniser> MakeFuzzyRulesRecogniser(std::span<const TaughtMove> taught, const TrackingWeights& weights,
                                                     const FuzzyRulesOptions& options);

/// Returns for each key pose of a move the index of the first frame in which this pose and all poses before it have
/// been reached in order by A's crisp rule; nullopt for a pose that is never reached.
std::vector<std::optional<int>> WhenReached(std::span<const TaughtPose> poses, std::span<const FeatureFrame> frames,
                                            const TrackingWeights& weights, const KeyPoseOptions& options);

}  // namespace etude
