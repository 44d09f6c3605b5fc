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

/// A truth and an answer, joint by joint and frame by frame, and what was done to the answer.
struct MatchedMotions {
  EvaluatedPair pair;
  std::vector<std::string> joints;                ///< the joints judged
  std::vector<int> parents;                       ///< of each, the next of them towards the root; −1: none
  std::vector<std::string> lacking;               ///< joints of the set that one of both has not
  std::vector<std::array<std::size_t, 3>> bends;  ///< knees and elbows among them: above, middle, below
  AngleTracks true_angles, found_angles;  ///< the angles that both have, by name; empty: one of both has no rotations
  std::size_t uncovered = 0;              ///< frames of the truth outside the answer
  std::optional<TimeShift> lag;           ///< that was found and taken out
  std::string note;                       ///< one line
};

/// The frame of the answer that belongs to the truth's first.
enum class Lag {
  kNone,  ///< its first
  kFind,  ///< the one, or the place between two, that FindTimeShift finds
};

/// Matches an answer to a truth. `joints` is a set (JointSetNames). The frames are the truth's, and the answer is
/// sampled at the truth's times (`Sampled`), later by the lag. Rates that drift apart by less than a hundredth of a
/// frame over the truth are the same, so frames pair one to one. The root, which also plays hip_centre, is the
/// files' own if both have one, else midway between the hips in both. Nothing else is changed. Fails if no joint is
/// common, none is ever seen by both, or a lag is sought and not found.
Result<MatchedMotions> Match(const RawMotion& truth, const RawMotion& answer, std::string_view joints, Lag lag);

}  // namespace etude
