#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/fuzzy/distance.h"
#include "engine/motion/body.h"

namespace etude {

/// The pair that is taken of several matching pairs of frames.
enum class Pick {
  kFirst,     ///< paper A: the first one found
  kSmallest,  ///< A's other wording ("the smallest difference"): the smallest distance in the window
};

/// The rules by which two frames match, for everything that goes by the fuzzy distance (equation 1).
struct MatchRules {
  FeatureWeights weights = PaperWeights();
  /// The threshold of a match: frames match when their distance is below it. Paper A's: 0.4. A larger one finds more
  /// direct transitions, and worse ones (docs/transitions.md).
  double threshold = kPaperThreshold;
  Pick pick = Pick::kFirst;
  bool within_class = false;  ///< ours: only frames with the same ten tags match
};

/// A request: clip `from` shows its frame `request_frame` when clip `to` is wanted.
struct TransitionRequest {
  int from = 0;
  int request_frame = 0;
  int to = 0;
  double budget_s = 1;  ///< how long the wanted clip may be waited for, seconds; ours
};

/// The kind of way that a transition took.
enum class Branch { kNone, kNow, kEnd, kStandingPose, kFrontHalf, kRearHalf, kInBetween, kForced, kUnbroken };
/// Returns "none", "now", "end", "standing pose", "front half", "rear half", "in-between", "forced", "unbroken".
std::string_view BranchName(Branch branch);

/// The ways in which the joins `minimum-jerk` and `planted-feet` get from the old motion to the new one.
enum class JoinWay {
  kDecays,  ///< the new motion plays, and what the old one was off from it dies away
  kFades,   ///< both motions play on, and the new one takes over
  kDirect,  ///< each limb moves from where the old motion left it to where the new one has it at the end
};

/// The join that a choice of frames prefers; set by `played`, which tries several, and by answers of methods outside.
struct PreferredJoin {
  double blend_s = 0;  ///< seconds until the new motion is shown alone
  JoinWay way = JoinWay::kDecays;
};

/// A run of frames that is shown: of a clip, or made by the method itself.
///
/// The first segment's `first` is the frame shown at the request. Of every later one, frame `first` counts as one with
/// the last frame shown: it is laid on it (yaw, x, z) and the next is shown after it.
struct Segment {
  static constexpr int kOwnFrames = -1;
  int clip = kOwnFrames;                        ///< of the library
  int first = 0;                                ///< index into the clip, or into `own`
  int last = 0;                                 ///< the last frame shown
  std::vector<BodyPose> own;                    ///< only of kOwnFrames
  std::optional<PreferredJoin> preferred = {};  ///< of the join into it
  bool in_place = false;                        ///< `own` stands where it is to be shown: it is not laid on anything
};

/// The outcome of a pair of frames that a choice looked at.
enum class CandidateOutcome {
  kTaken,
  kTooFar,  ///< its distance is not below the threshold
  kLater,   ///< it matches, but the first match is taken
  kWorse,   ///< it matches, but another ranks before it
};
/// Returns "taken", "too far", "later" or "worse".
std::string_view OutcomeName(CandidateOutcome outcome);

/// A pair of frames that a choice looked at.
struct Candidate {
  int from_frame = 0;  ///< of the clip that was left, or (through an in-between) of the in-between
  int to_frame = 0;    ///< of the clip entered, or of the in-between
  FuzzyDistance distance;
  std::optional<double> cost;  ///< what the choice ranks by, where that is not the distance
  CandidateOutcome outcome = CandidateOutcome::kTooFar;
  int point = 0;  ///< for which transition point of the record it was looked at, from 0
};

/// The record that explains a transition: how to get from one clip into another, and how that was found.
struct TransitionRecord {
  Branch branch = Branch::kNone;
  int request_frame = 0;
  std::vector<Segment> segments;         ///< none when there is no way; two when it is direct, three with an in-between
  std::vector<FuzzyDistance> distances;  ///< of the two frames of each transition point: segments.size() − 1
  std::vector<Candidate> candidates;     ///< taken, and the best of the others: at most kMostCandidates, by frames
  std::int64_t pairs_seen = 0;           ///< pairs of frames that the budget allowed, those after a first match too
  std::int64_t pairs_matched = 0;        ///< those of them that match
  double wait_s = 0;                     ///< from the request until the wanted clip plays
  std::string cost_unit;                 ///< of the candidates' `cost`: "cm", … ; empty when there is none
  std::string why;                       ///< one sentence: why this way won, or why there is none
};
constexpr std::size_t kMostCandidates = 12;

/// Returns the time that the segments take from the request until the last one begins, seconds.
double WaitOf(const std::vector<Segment>& segments, double rate_hz);

}  // namespace etude
