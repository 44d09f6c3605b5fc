#pragma once

#include <string>
#include <vector>

#include "bench/tasks/evaluation/common_joints.h"
#include "bench/tasks/evaluation/match.h"
#include "engine/motion/raw_motion.h"

namespace etude {

/// Returns doubts, as sentences for users, about whether two files describe one motion in the same way. A doubt states
/// one change of the answer that removes most of its error, so the error may come from how a file was written:
/// - the root of one file stays at the origin, and the other one's does not (positions relative to the root);
/// - axes: a permutation of the answer's axes, some of them reversed, removes nine tenths of the mean joint error
///   (if there is a doubt about one of the files, only with Y up in both);
/// - time: at another rate, or after a shift of one frame to kMaxTimeShift_s, distances between joints agree at least
///   twice as well, and FindTimeShift finds a shift, too. This is not searched if the best shift was already removed
///   (`matched.lag`).
/// Limits and method are our own. `common` are the judged joints, which `matched` holds frame by frame; the truth's
/// first frame is paired with the answer at `start_s`.
std::vector<std::string> DoubtsOnPair(const RawMotion& truth, const RawMotion& answer,
                                      const std::vector<CommonJoint>& common, const MatchedMotions& matched,
                                      double start_s);

}  // namespace etude
