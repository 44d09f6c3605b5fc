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

/// A training frame. Its membership grades are not stored, because training may change the membership functions.
struct TrainingFrame {
  BodyPose pose;
  PoseFeatures features;
};

/// Training clips, performed by one body. Weights for a transition are never learnt from the two clips of that
/// transition.
struct TrainingClips {
  /// Names of the clips, equal for equal clips: "builtin:clap", or the file.
  std::vector<std::string> identities;
  std::vector<std::vector<TrainingFrame>> frames;  ///< frames of each clip, sampled evenly
};

/// The number of frames sampled from a clip. They are the middle frames of equal parts of the clip, so a long clip does
/// not count more than a short one. If a clip has fewer frames, all are used.
constexpr int kFramesPerClip = 16;

/// Retargets clips to `proportions` and samples their frames. The order of the clips is kept.
TrainingClips SampleClips(std::vector<std::string> identities, std::span<const BodyMotion> clips,
                          const BodyProportions& proportions);

/// The largest number of training clips. The number of pairs grows with the square of the number of clips, so more
/// clips would make learning slow, and would improve it little.
constexpr std::size_t kMaxTrainingClips = 40;

/// Returns the training clips, retargeted to `proportions`: every built-in move, and every clip unless a move or an
/// earlier clip has the same identity. `identities` has one entry per clip. If moves and clips together are more than
/// kMaxTrainingClips, clips at even distances in the list are taken, and the other clips are left out.
Result<TrainingClips> GatherTrainingClips(std::span<const BodyMotion> clips, const std::vector<std::string>& identities,
                                          const BodyProportions& proportions);

/// Returns every pair that consists of a frame of `a` and a frame of `b`. A pair is labelled close if its true pose gap
/// is below kCloseGap.
std::vector<LabelledPair> LabelPairs(std::span<const TrainingFrame> a, std::span<const TrainingFrame> b,
                                     const Memberships& memberships = PaperMemberships());

/// Returns the results of LabelPairs for every two different clips, in one list.
std::vector<LabelledPair> LabelPairsAcross(std::span<const std::vector<TrainingFrame>> clips,
                                           const Memberships& memberships = PaperMemberships());

/// Computes the grade differences of `pairs` again with other memberships. LabelPairsAcross must have returned `pairs`
/// for the same clips. This is much faster than LabelPairsAcross, because poses are not compared again.
void UpdateGrades(std::span<const std::vector<TrainingFrame>> clips, const Memberships& memberships,
                  std::span<LabelledPair> pairs);

/// Counts how well "d < threshold" separates close pairs from others.
struct MatchScore {
  int matched = 0;        ///< number of pairs with d < threshold
  int close = 0;          ///< number of close pairs
  int close_matched = 0;  ///< number of close pairs with d < threshold

  /// Returns F1, the harmonic mean of precision (the share of matched pairs that are close) and recall (the share of
  /// close pairs that are matched); 0 if no close pair is matched. Accuracy and AUC are not used: there are few close
  /// pairs, and both measures are dominated by the many distant pairs, which no threshold near 0.4 ever matches.
  double F1() const { return close_matched > 0 ? 2.0 * close_matched / (matched + close) : 0; }
};

/// Labelled pairs, stored feature by feature in single precision, so that many weights can be scored quickly.
class PairTable {
 public:
  explicit PairTable(std::span<const LabelledPair> pairs);

  MatchScore Score(const FeatureWeights& weights, double threshold = kPaperThreshold) const;
  /// Returns F1 with a soft threshold. The share by which a pair counts as matched falls linearly from 1 to 0 while d²
  /// rises from (1 − ramp) · threshold² to (1 + ramp) · threshold². `ramp` > 0.
  double SoftF1(const FeatureWeights& weights, double threshold, double ramp) const;

 private:
  /// The number of pairs in a block. The values of a block are stored next to each other.
  static constexpr int kBlock = 64;
  struct Block {
    float squared_gaps[kFeatureCount][kBlock];
    int used[kBlock];   // 1 for a pair, 0 for unused places in the last block
    int close[kBlock];  // 1 if the pair is close, else 0
  };
  static void AddUp(const Block& block, const FeatureWeights& weights, float (&squared)[kBlock]);

  std::vector<Block> blocks_;
  int close_count_ = 0;
};

}  // namespace etude
