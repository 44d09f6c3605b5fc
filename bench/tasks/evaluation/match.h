#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "bench/metrics/evaluation.h"
#include "bench/metrics/joint_angles.h"
#include "bench/metrics/time_shift.h"
#include "engine/base/result.h"
#include "engine/motion/raw_motion.h"

namespace etude {

/// Truth and answer at the truth's times, to show them; the answer is interpolated.
struct ShownMotions {
  PointTracks truth, answer;
  double rate_hz = 0;
};

/// A truth and an answer, matched joint by joint and frame by frame, with a note on the changes made to the answer.
struct MatchedMotions {
  EvaluatedPair pair;
  /// The answer alone at all its frames within the truth, if it has more frames than the truth; else `pair` has them.
  std::optional<EvaluatedPair> own = {};
  std::optional<ShownMotions> shown = {};  ///< the motions to show, if `pair` does not have the truth's times
  double own_start_s = 0;            ///< the time of the first frame of OwnFrames, in seconds after the truth's first
  double truth_begin_s = 0;          ///< the time of the truth's first frame by its file's clock; 0 without a clock
  bool is_interpolated = false;      ///< true: the truth has no frames at these times, so it was interpolated
  bool is_even = true;               ///< true: the frames of `pair` follow each other at equal times
  std::vector<std::string> joints;   ///< the judged joints
  std::string root;                  ///< which joint is the root, as text; "" if a motion has no root
  std::vector<int> parents;          ///< for each joint, the next judged joint towards the root; −1: none
  std::vector<std::string> lacking;  ///< joints of the set that are not found in both motions
  std::vector<std::string> also_held;  ///< joints of equal names in both motions that are not judged
  /// Knees and elbows: the joint above, the joint itself, the joint below.
  std::vector<std::array<std::size_t, 3>> bends;
  AngleTracks true_angles, found_angles;  ///< the angles that both motions have; empty if a motion has no rotations
  std::size_t uncovered = 0;              ///< number of frames of the truth that the answer does not cover
  std::size_t surplus = 0;                ///< number of frames of the answer that the truth does not cover
  std::optional<TimeShift> lag;           ///< the time shift that was found and removed
  std::string note;                       ///< a note on the match, in one line
  std::vector<std::string> doubts;        ///< whether the files describe one motion in the same way (DoubtsOnPair)

  /// Returns the answer's own frames, for metrics of the answer alone. Fields of the truth may be empty.
  const EvaluatedPair& OwnFrames() const { return own ? *own : pair; }
};

/// The time of the answer that is paired with the truth's first frame.
enum class Lag {
  kNone,  ///< the same time by the clocks of both files; the answer's first frame if they state no common clock
  kFind,  ///< the time that FindTimeShift finds, which may be between two frames
};

/// Matches an answer with a truth. `joints` is the name of a set of joints (JointSetNames). The answer is judged at its
/// own frames and never interpolated, because interpolation would smooth it; if it has the higher rate, at the frame
/// nearest to each of the truth's. Where the truth has no frame within a hundredth of a frame of that time (plus the
/// lag), it is interpolated by a cubic (Inbetween::kCubic). The two frame rates count as equal, so that frames are
/// paired one to one, if the times of frames of equal number differ by less than a hundredth of a frame at the truth's
/// end. The root, which also has the role hip_centre, is the files' own if both have one; otherwise it is the midpoint
/// of the hips in both. Nothing else is changed. Fails if there is no common joint, if no joint is ever seen in both,
/// or if `lag` is kFind and no lag is found.
Result<MatchedMotions> Match(const RawMotion& truth, const RawMotion& answer, std::string_view joints, Lag lag);

}  // namespace etude
