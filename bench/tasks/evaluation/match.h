#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "bench/metrics/evaluation.h"
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
  std::size_t uncovered = 0;                      ///< frames of the truth outside the answer
  std::string note;                               ///< one line
};

/// Matches an answer to a truth. `joints` is a set (JointSetNames). The frames are the truth's: the answer's first
/// frame belongs to the truth's first, and the answer is sampled at the truth's times (`Sampled`). Rates that drift
/// apart by less than a hundredth of a frame over the truth are the same, so frames pair one to one. Nothing else is
/// changed. Fails if no joint is common, or none is ever seen by both.
Result<MatchedMotions> Match(const RawMotion& truth, const RawMotion& answer, std::string_view joints);

}  // namespace etude
