#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/fuzzy/features.h"
#include "engine/fuzzy/membership.h"
#include "engine/fuzzy/weights.h"
#include "engine/transitions/library/body_proportions.h"

namespace etude {

/// A frame to learn from. Its grades are left open, because membership functions may be what is learnt.
struct TrainingFrame {
  BodyPose pose;
  PoseFeatures features;
};

/// Clips to learn from, performed by one body. What is learnt for a transition never saw the two clips that it is
/// judged by.
struct TrainingClips {
  std::vector<std::string> identities;             ///< equal for equal dances: "builtin:clap", or the file
  std::vector<std::vector<TrainingFrame>> frames;  ///< of each clip, sampled evenly
};

/// The number of frames taken of a clip, in the middles of as many equal parts, so that long clips count no more than
/// short ones; all frames of a shorter clip.
constexpr int kFramesPerClip = 16;

/// Samples clips as they came, retargeted to `proportions`.
TrainingClips SampleClips(std::vector<std::string> identities, std::span<const BodyMotion> clips,
                          const BodyProportions& proportions);

/// The most clips to learn from. Pairs grow with the square of the clips: more would make learning slow, and teach
/// little.
constexpr std::size_t kMostTrainingClips = 40;

/// Gathers every built-in move and, by their identities, the other clips of `clips`, all retargeted to `proportions`.
/// Of more than kMostTrainingClips, evenly chosen ones.
Result<TrainingClips> GatherTrainingClips(std::span<const BodyMotion> clips, const std::vector<std::string>& identities,
                                          const BodyProportions& proportions);

/// Returns every pair of a frame of `a` and one of `b`, labelled close when its true pose gap is below kCloseGap.
std::vector<LabelledPair> LabelPairs(std::span<const TrainingFrame> a, std::span<const TrainingFrame> b,
                                     const Memberships& memberships = PaperMemberships());

/// Returns the pairs of all these clips, each of two different clips.
std::vector<LabelledPair> LabelPairsAcross(std::span<const std::vector<TrainingFrame>> clips,
                                           const Memberships& memberships = PaperMemberships());

/// Puts other memberships' gaps into the pairs that LabelPairsAcross made of the same clips: much quicker, because
/// poses are not compared again.
void GradeAnew(std::span<const std::vector<TrainingFrame>> clips, const Memberships& memberships,
               std::span<LabelledPair> pairs);

/// The score of telling close pairs from others by "d < threshold".
struct MatchScore {
  int matched = 0;        ///< pairs with d < threshold
  int close = 0;          ///< pairs that are close
  int close_matched = 0;  ///< both

  /// Returns the harmonic mean of precision (how many that are let through look alike) and recall (how many that look
  /// alike are let through, the choice that is left); 0 when no close pair is. Not accuracy or AUC: close pairs are
  /// few, and both of those are ruled by the mass of far pairs that no threshold near 0.4 ever lets through.
  double F1() const { return close_matched > 0 ? 2.0 * close_matched / (matched + close) : 0; }
};

/// Labelled pairs laid out for scoring many weights quickly: feature by feature, in single precision.
class PairTable {
 public:
  explicit PairTable(std::span<const LabelledPair> pairs);

  MatchScore Score(const FeatureWeights& weights, double threshold = kPaperThreshold) const;
  /// F1 with a threshold that is no cliff: a pair counts as let through by a share that falls evenly from 1 to 0 as d²
  /// goes from (1 − ramp) · threshold² to (1 + ramp) · threshold². `ramp` > 0.
  double SoftF1(const FeatureWeights& weights, double threshold, double ramp) const;

 private:
  /// Pairs of a block stand side by side.
  static constexpr int kBlock = 64;
  struct Block {
    float squared_gaps[kFeatureCount][kBlock];
    int used[kBlock];   // 1; 0 in the rest of the last block
    int close[kBlock];  // 1 or 0
  };
  static void AddUp(const Block& block, const FeatureWeights& weights, float (&squared)[kBlock]);

  std::vector<Block> blocks_;
  int close_count_ = 0;
};

}  // namespace etude
