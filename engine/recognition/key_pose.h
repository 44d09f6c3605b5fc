#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/recognition/features_seen.h"

namespace etude {

/// One angle of a key pose (paper A, "key pose on a few angles").
struct PoseTarget {
  Feature feature = Feature::kRH;
  double degrees = 0;
  double tolerance_deg = 0;  ///< > 0
};

/// A pose that must be reached for the move to count.
struct TaughtPose {
  std::vector<PoseTarget> targets;  ///< at least one
};

/// What the recogniser knows of a move: the poses to be reached, in this order.
struct TaughtMove {
  std::string name;
  std::vector<TaughtPose> poses;  ///< at least one
  /// From the first pose reached to the last at most so many frames may pass where nobody says when the move is due
  /// (FindMove): one performance at the slowest tempo allowed. By default any number, so that poses of two performances
  /// may be taken for one.
  int span_frames = std::numeric_limits<int>::max();
};

/// How much a feature counts.
enum class Weighting {
  kFixed,     ///< every feature 1: A's
  kAdaptive,  ///< by how well its joints are seen (ours)
};

/// When a key pose counts as reached. Evidence: `scenarios/quick/detection.yaml`, an answer with a sensor's errors.
struct KeyPoseOptions {
  /// Fixed, because it is A's. Adaptive where a miss costs more than praise for a mistake, most of all where the body
  /// hides its own far side: it finds more performances, and pays in precision and false alarms, because what is not
  /// seen is not counted, mistakes included.
  Weighting weights = Weighting::kFixed;
  /// The weighted share of satisfied targets from which on a pose counts as reached, in (0, 1]. At 0.8 (ours) fixed
  /// weights demand every angle of a pose of up to four, as A does; adaptive ones demand every angle that is seen, and
  /// let one guessed angle of three or four be off. Lower for a noisy sensor: 0.75 forgives one angle of four, finds
  /// most of what twice the noise hides, and gives several times as many false alarms. At 1 the weights decide nothing,
  /// unless one of them is 0.
  double threshold = 0.8;
  /// For how many seen frames in a row a pose must be met, ≥ 1. Three (ours), 0.1 s at 30 Hz, so that a pose which
  /// noise passes through is none. Change it with the frame rate; every frame more delays each answer by one, and a
  /// quick performer does not hold a pose for long.
  int hold_frames = 3;
  /// What an angle counts whose joints are all tracked. The yardstick of the other two: leave it.
  double tracked_weight = 1.0;
  /// What an angle with an inferred joint counts (adaptive weights), in [0, 1]. At 0.3 (ours) three guessed angles
  /// cannot outvote one that is seen. Raise it for a sensor whose guesses are good; at 1 adaptive weights are fixed
  /// ones for whatever is tracked or inferred.
  double inferred_weight = 0.3;
  /// What an angle with a joint that is not tracked counts (adaptive weights), in [0, 1]. Nothing, because such a joint
  /// repeats where it was last. Raise it only for a sensor that goes on reporting joints it calls not tracked.
  double not_tracked_weight = 0.0;
};

/// The weighted share of targets met in this frame, in [0, 1]; 0 when no target has any weight.
double MatchedShare(const FeatureFrame& frame, const TaughtPose& pose, const KeyPoseOptions& options);

/// The same, softly: a target counts 1 / (1 + (error / tolerance)²), so ½ at its tolerance.
double SoftMatch(const FeatureFrame& frame, const TaughtPose& pose, const KeyPoseOptions& options);

/// Follows one move through a stream, frame by frame. A frame without a body changes nothing.
class KeyPoseRecogniser {
 public:
  /// `span_frames`: from the first pose reached to the last at most so many frames may pass. The
  /// arguments must outlive this.
  KeyPoseRecogniser(const TaughtMove& move, const KeyPoseOptions& options, int span_frames);

  /// True in the frame in which the last pose is reached after all others in their order. Then
  /// starts anew, once the last pose was left.
  bool Update(const FeatureFrame& frame);

  /// How well the best passage so far fits, in [0, 1]: of the best choice of frames in order, the
  /// soft match of its worst pose. Never falls.
  double Score() const { return best_scores_.back(); }

 private:
  struct PoseProgress {
    int held = 0;                // matching frames in a row
    std::optional<int> started;  // the latest first-pose frame of a passage that got this far
    std::vector<double> recent;  // soft matches of the last `hold_frames` frames, a ring
  };

  double HeldScore(const PoseProgress& progress) const;

  const TaughtMove& move_;
  const KeyPoseOptions& options_;
  int span_frames_;
  int frame_ = 0;
  int seen_ = 0;
  bool armed_ = true;
  std::vector<PoseProgress> poses_;
  std::vector<double> best_scores_;
};

/// What the coach concludes about one performance it asked for.
struct Judgement {
  std::optional<int> recognised_at;   ///< frame within the window; empty: the move was not recognised
  double score = 0;                   ///< soft, in [0, 1], for ROC curves
  std::vector<double> running_score;  ///< per frame of the window
};

/// Judges `window`, the frames in which the move was to be performed: its length bounds the performance.
Judgement JudgeWindow(std::span<const FeatureFrame> window, const TaughtMove& move, const KeyPoseOptions& options);

/// Every frame at which the move was recognised, with the recogniser running all the time.
std::vector<int> FindMove(std::span<const FeatureFrame> frames, const TaughtMove& move, const KeyPoseOptions& options);

}  // namespace etude
