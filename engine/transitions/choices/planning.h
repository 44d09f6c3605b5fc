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

/// The frames that a choice may take, both in rising order: each of `leave` with each of `enter` is a pair.
struct AllowedFrames {
  std::vector<int> leave;  ///< of the playing clip
  std::vector<int> enter;  ///< of the wanted clip

  std::int64_t Pairs() const { return static_cast<std::int64_t>(leave.size() * enter.size()); }
};

/// Returns the bridge frames within the request's budget, and those of the wanted clip but its last frame.
AllowedFrames AllowedBridgeFrames(const MotionLibrary& library, const TransitionRequest& request);

/// Returns all frames within the budget, and those of the wanted clip that leave `least_play_s` seconds of it to play,
/// or lie in its front half; one pair at least when the wanted clip has two frames.
AllowedFrames AllowedAnyFrames(const MotionLibrary& library, const TransitionRequest& request, double least_play_s);

/// Returns all frames within the budget, and those of the wanted clip's first third that skip `most_skipped_s` seconds
/// of it at most; one pair at least when the wanted clip has two frames.
AllowedFrames AllowedEarlyFrames(const MotionLibrary& library, const TransitionRequest& request, double most_skipped_s);

/// Makes a record of two segments: the playing clip up to `leave_frame`, the wanted one after `enter_frame`. The branch
/// is by half (paper A, section 3.5), the distance by the rules' weights; why is left to the caller.
TransitionRecord DirectTransition(const MotionLibrary& library, const TransitionRequest& request, int leave_frame,
                                  int enter_frame, const MatchRules& rules);

/// A pair of frames with a choice's rank.
struct RankedPair {
  int from = 0, to = 0;
  bool matches = false;        ///< a transition point may be there
  double rank = 0;             ///< less is better, among those that match or among those that do not
  std::optional<double> cost;  ///< as the record shows it
};

/// Lists the taken pair and the best of the others, kMostCandidates at most, by frames. `others` does not hold the
/// taken one; those of them that match have the outcome `passed_over`.
std::vector<Candidate> ListCandidates(const MotionLibrary& library, const TransitionRequest& request,
                                      const MatchRules& rules, const RankedPair& taken, std::vector<RankedPair> others,
                                      CandidateOutcome passed_over);

/// Describes "no match among 900 pairs of bridge frames: the nearest has d = 0.52, not below 0.4". `nearest` holds
/// pairs that do not match, ranked by d; none when no two frames were comparable. `frames` says what of: "bridge
/// frames".
std::string DescribeNoMatch(const std::vector<RankedPair>& nearest, std::int64_t pairs, std::string_view frames,
                            const MatchRules& rules);

/// Describes a pair as "boxing frame 41 (0.37 s after the request) and clap frame 3".
std::string DescribePair(const MotionLibrary& library, const TransitionRequest& request, int from, int to);

/// Finds the frames that may be entered from a frame that is left: those with d below the rules' threshold. Frames that
/// the rules do not compare, being of another class, are left out.
class FuzzyGate {
 public:
  /// Compares frames of two clips; clips and rules must outlive this.
  FuzzyGate(const TaggedClip& playing, const TaggedClip& next, std::vector<int> entering, const MatchRules& rules);

  struct Compared {
    int to = 0;
    double distance = 0;
    bool matches = false;
  };
  /// Compares a frame of the playing clip with all that may be entered, in their order. Valid until the next call.
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
