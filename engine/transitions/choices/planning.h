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

/// The frames that a choice may take; both lists are in ascending order. Every frame of `leave` may be paired with
/// every frame of `enter`.
struct AllowedFrames {
  std::vector<int> leave;  ///< frames of the playing clip
  std::vector<int> enter;  ///< frames of the wanted clip

  std::int64_t Pairs() const { return static_cast<std::int64_t>(leave.size() * enter.size()); }
};

/// Returns the bridge frames of the playing clip within the request's budget, and all bridge frames of the wanted clip
/// except its last frame.
AllowedFrames AllowedBridgeFrames(const MotionLibrary& library, const TransitionRequest& request);

/// Returns all frames of the playing clip within the budget, and the frames of the wanted clip that lie in its front
/// half or after which at least `least_play_s` seconds remain. If the wanted clip has two or more frames, the result
/// allows at least one pair of frames.
AllowedFrames AllowedAnyFrames(const MotionLibrary& library, const TransitionRequest& request, double least_play_s);

/// Returns all frames of the playing clip within the budget, and the frames in the wanted clip's first third that are
/// at most `most_skipped_s` seconds after its start. If the wanted clip has two or more frames, the result allows at
/// least one pair of frames.
AllowedFrames AllowedEarlyFrames(const MotionLibrary& library, const TransitionRequest& request, double most_skipped_s);

/// Makes a record of two segments: the playing clip up to `leave_frame`, then the wanted clip from `enter_frame` on.
/// The record's branch states which half of the clip is entered (paper A, section 3.5), and its distance uses the
/// rules' weights. The caller fills in `why`.
TransitionRecord DirectTransition(const MotionLibrary& library, const TransitionRequest& request, int leave_frame,
                                  int enter_frame, const MatchRules& rules);

/// A pair of frames, and its rank in a choice.
struct RankedPair {
  int from = 0, to = 0;
  bool matches = false;        ///< the pair may be a transition point
  double rank = 0;             ///< lower is better; any matching pair is better than a pair that does not match
  std::optional<double> cost;  ///< the cost that the record states for this pair
};

/// Returns the taken pair and the best of `others` (which must not contain the taken pair), at most kMaxCandidates in
/// total, in order of their frames. Pairs of `others` that match get the outcome `passed_over`.
std::vector<Candidate> ListCandidates(const MotionLibrary& library, const TransitionRequest& request,
                                      const MatchRules& rules, const RankedPair& taken, std::vector<RankedPair> others,
                                      CandidateOutcome passed_over);

/// Returns a sentence such as "no match among 900 pairs of bridge frames: the nearest has d = 0.52, not below 0.4".
/// `nearest` are pairs that do not match, ranked by d; the list is empty if no two frames could be compared. `frames`
/// names the kind of frames, for example "bridge frames".
std::string DescribeNoMatch(const std::vector<RankedPair>& nearest, std::int64_t pairs, std::string_view frames,
                            const MatchRules& rules);

/// Returns a description such as "boxing frame 41 (0.37 s after the request) and clap frame 3".
std::string DescribePair(const MotionLibrary& library, const TransitionRequest& request, int from, int to);

/// Compares one frame of the playing clip with all frames at which the wanted clip may be entered; frames with d below
/// the rules' threshold match. If the rules compare only frames with the same ten tags (`within_class`), all other
/// frames are left out.
class FuzzyGate {
 public:
  /// Compares frames of two clips. The clips and the rules must outlive this object.
  FuzzyGate(const TaggedClip& playing, const TaggedClip& next, std::vector<int> entering, const MatchRules& rules);

  struct Compared {
    int to = 0;
    double distance = 0;
    bool matches = false;
  };
  /// Compares frame `from` of `playing` with the frames in `entering`, in their order. With MatchRules::within_class,
  /// frames whose ten tags are not equal to those of `from` are left out. The span is valid until the next call.
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
