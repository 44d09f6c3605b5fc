#pragma once

#include <string>
#include <vector>

#include "bench/tasks/evaluation/common_joints.h"
#include "bench/tasks/evaluation/match.h"

namespace etude {

/// Returns doubts, as sentences for users, about whether two files describe one motion in the same way. A doubt states
/// one change of the answer that removes most of its error. The error may then come from how a file was written:
/// - the root of one file stays at the origin, and the other one's does not (positions relative to the root);
/// - axes: a permutation of the answer's axes, some of them reversed, removes nine tenths of the mean joint error
///   (if there is a doubt about one of the files, only with Y up in both);
/// - place: if none of these, one displacement of all positions removes 96 % of the mean joint error;
/// - heading and size: if none of these, one rotation, displacement and size of all positions removes nine tenths of it
///   (if there is a doubt about one of the files, only with Y up in both);
/// - sides: with left and right exchanged, the differences of the distances between joints are at most half as large,
///   and the answer's left and right hip are in the opposite order to the truth's hips;
/// - time: at another rate, or after a shift, the differences of the distances between joints are at most half as
///   large. A shift has at least one frame and at most kMaxTimeShift_s, it leaves at most 8 cm, and FindLag must find a
///   shift, too. If a lag was already removed (`matched.lag`), neither sides nor shifts are searched;
/// - clock: with shifts that change evenly or jump once, those differences are at most half as large as with any
///   constant shift, and at most 8 cm.
/// Limits and method are our own. `matched` holds the judged joints frame by frame. The truth's first frame is paired
/// with the answer at `start_s`.
std::vector<std::string> DoubtsOnPair(const JudgedSide& truth, const JudgedSide& answer, const MatchedMotions& matched,
                                      double start_s);

}  // namespace etude
