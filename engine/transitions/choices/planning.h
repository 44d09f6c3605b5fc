#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/transitions/choices/pair_rows.h"
#include "engine/transitions/library/library.h"
#include "engine/transitions/library/transition_points.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// The frames that a choice may take, both lists in rising order. Each of `leave` forms a pair with each of `enter`.
struct AllowedFrames {
  std::vector<int> leave;  ///< of the playing clip
  std::vector<int> enter;  ///< of the wanted clip

  std::int64_t Pairs() const { return static_cast<std::int64_t>(leave.size() * enter.size()); }
};

/// Returns the bridge frames of the playing clip within the request's budget, and those of the wanted clip except its
/// last frame.
AllowedFrames AllowedBridgeFrames(const MotionLibrary& library, const TransitionRequest& request);

/// Returns all frames of the playing clip within the budget, and the frames of the wanted clip that leave at least
/// `least_play_s` seconds to play or lie in its front half. There is at least one pair if the wanted clip has two
/// frames.
AllowedFrames AllowedAnyFrames(const MotionLibrary& library, const TransitionRequest& request, double least_play_s);

/// Returns all frames of the playing clip within the budget, and the frames in the wanted clip's first third that skip
/// at most `most_skipped_s` seconds. There is at least one pair if the wanted clip has two frames.
AllowedFrames AllowedEarlyFrames(const MotionLibrary& library, const TransitionRequest& request, double most_skipped_s);

/// Makes a record of two segments: the playing clip up to `leave_frame`, then the wanted clip from `enter_frame` on.
/// The branch tells the half (paper A, section 3.5), and the distance uses the rules' weights. The caller fills in
/// `why`.
TransitionRecord DirectTransition(const MotionLibrary& library, const TransitionRequest& request, int leave_frame,
                                  int enter_frame, const MatchRules& rules);

/// A pair of frames with the rank that a choice gives it.
struct RankedPair {
  int from = 0, to = 0;
  bool matches = false;        ///< the pair may be a transition point
  double rank = 0;             ///< lower is better; compared among matching pairs, or among pairs that do not match
  std::optional<double> cost;  ///< as the record shows it
};

/// Returns the taken pair and the best of `others` (which must not hold the taken pair), at most kMaxCandidates in
/// total, in order of their frames. Others that match get the outcome `passed_over`.
std::vector<Candidate> ListCandidates(const MotionLibrary& library, const TransitionRequest& request,
                                      const MatchRules& rules, const RankedPair& taken, std::vector<RankedPair> others,
                                      CandidateOutcome passed_over);

/// Returns, for example, "no match among 900 pairs of bridge frames: the nearest has d = 0.52, not below 0.4".
/// `nearest` holds pairs that do not match, ranked by d; it is empty if no two frames could be compared. `frames` names
/// the kind of frames, for example "bridge frames".
std::string DescribeNoMatch(const std::vector<RankedPair>& nearest, std::int64_t pairs, std::string_view frames,
                            const MatchRules& rules);

/// Returns, for example, "boxing frame 41 (0.37 s after the request) and clap frame 3".
std::string DescribePair(const MotionLibrary& library, const TransitionRequest& request, int from, int to);

/// Compares a frame that is left with all frames that may be entered; those with d below the rules' threshold match.
/// Frames of another class are left out if the rules compare within classes only.
class FuzzyGate {
 public:
  /// Compares frames of two clips. The clips and the rules must outlive this object.
  FuzzyGate(const TaggedClip& playing, const TaggedClip& next, std::vector<int> entering, const MatchRules& rules);

  struct Compared {
    int to = 0;
    double distance = 0;
    bool matches = false;
  };
  /// Compares a frame of the playing clip with all frames that may be entered, in order. The span is valid until the
  /// next call.
  std::span<const Compared> Compare(int from);

 private:
  const TaggedClip &playing_, &next_;
  std::vector<int> entering_;
  const MatchRules& rules_;
  FuzzyRows rows_;
  std::vector<double> distances_;
  std::vector<Compared> compared_;
};

}  // namespace etude
