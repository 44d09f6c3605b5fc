#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/fuzzy/distance.h"
#include "engine/motion/body.h"

namespace etude {

/// The rule that decides which of several matching pairs of frames is taken.
enum class Pick {
  kFirst,     ///< the first match that is found, as in paper A
  kSmallest,  ///< the smallest distance in the window; paper A also says "the smallest difference"
};

/// The rules that decide whether two frames match by the fuzzy distance (paper A, equation 1).
struct MatchRules {
  FeatureWeights weights = PaperWeights();
  /// Frames match if their distance is below this threshold; paper A's value is 0.4. A larger value finds more direct
  /// transitions, but also worse ones (docs/transitions.md).
  double threshold = kPaperThreshold;
  Pick pick = Pick::kFirst;
  bool within_class = false;  ///< if true, only frames with the same ten tags match *(ours)*
};

/// A request for a transition: clip `from` shows its frame `request_frame` when clip `to` is requested.
struct TransitionRequest {
  int from = 0;
  int request_frame = 0;
  int to = 0;
  double budget_s = 1;  ///< maximal wait before the transition, seconds *(ours)*
};

/// The kind of transition that was found.
enum class Branch { kNone, kNow, kEnd, kStandingPose, kFrontHalf, kRearHalf, kInBetween, kForced, kUnbroken };
/// Returns "none", "now", "end", "standing pose", "front half", "rear half", "in-between", "forced" or "unbroken".
std::string_view BranchName(Branch branch);

/// The ways in which the joins `minimum-jerk` and `planted-feet` change from the old motion to the new one.
enum class JoinStyle {
  kDecays,  ///< the new motion plays, and the old motion's offset from the new one decays
  kFades,   ///< both motions play, and the new motion's share grows
  kDirect,  ///< each limb moves from its old pose to the new motion's pose at the end of the join
};

/// The join that a choice of frames prefers. The choice `played`, which tries several joins, sets a PreferredJoin;
/// answers of outside methods may also set one.
struct PreferredJoin {
  double blend_s = 0;  ///< time until only the new motion is shown, seconds
  JoinStyle way = JoinStyle::kDecays;
  /// True: the new motion is placed where the body's momentum carries it (CarriedShift). False: the feet that stand in
  /// both motions determine its place (AlignOnPlantedFeet). Only `planted-feet` uses this.
  bool carried = false;
};

/// A run of frames to show. The frames belong to a clip or were made by the method.
///
/// In the first segment, `first` is the frame shown at the request. In every later segment, frame `first` is aligned
/// (yaw, x, z) with the last shown frame and replaces it; the next frame to be shown is `first` + 1.
struct Segment {
  static constexpr int kOwnFrames = -1;
  int clip = kOwnFrames;                        ///< index in the library, or kOwnFrames
  int first = 0;                                ///< index in the clip or in `own`
  int last = 0;                                 ///< index of the last frame shown
  std::vector<BodyPose> own;                    ///< frames made by the method, only with kOwnFrames
  std::optional<PreferredJoin> preferred = {};  ///< the preferred join into this segment
  bool in_place = false;                        ///< true if `own` is already aligned
};

/// The outcome for a pair of frames that a choice considered.
enum class CandidateOutcome {
  kTaken,
  kTooFar,  ///< the pair's distance is not below the threshold
  kLater,   ///< the pair matches, but an earlier match is taken
  kWorse,   ///< the pair matches, but another pair ranks higher
};
/// Returns "taken", "too far", "later" or "worse".
std::string_view OutcomeName(CandidateOutcome outcome);

/// A pair of frames that a choice considered.
struct Candidate {
  int from_frame = 0;  ///< index in the playing clip, or in the in-between
  int to_frame = 0;    ///< index in the wanted clip, or in the in-between
  FuzzyDistance distance;
  std::optional<double> cost;  ///< the cost by which the choice ranks pairs; nullopt if it ranks them by `distance`
  CandidateOutcome outcome = CandidateOutcome::kTooFar;
  int point = 0;  ///< index of the record's transition point to which the pair belongs
};

/// The record of a transition: its segments, and how they were found.
struct TransitionRecord {
  Branch branch = Branch::kNone;
  int request_frame = 0;
  /// Empty: no transition was found. Two segments: a direct transition (or unbroken motion). Three segments: a
  /// transition through an in-between, a standing pose or an intermediate clip.
  std::vector<Segment> segments;
  std::vector<FuzzyDistance> distances;  ///< one per transition point: segments.size() − 1 entries
  /// The taken pair and the best other pairs, at most kMaxCandidates, in order of frames.
  std::vector<Candidate> candidates;
  std::int64_t pairs_seen = 0;     ///< number of pairs within the budget, including pairs after the first match
  std::int64_t pairs_matched = 0;  ///< number of these pairs that match
  double wait_s = 0;               ///< time from the request until the wanted clip plays
  std::string cost_unit;           ///< unit of the candidates' `cost`, for example "cm"; empty without costs
  std::string why;                 ///< one sentence: why this transition was taken, or why there is none
};
constexpr std::size_t kMaxCandidates = 12;

/// Returns the time in seconds from the request until the last segment begins.
double WaitOf(const std::vector<Segment>& segments, double rate_hz);

}  // namespace etude
