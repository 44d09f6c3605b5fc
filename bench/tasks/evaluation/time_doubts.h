#pragma once

#include <string>

#include "bench/tasks/evaluation/common_joints.h"

namespace etude {

/// Returns a doubt if the answer fits far better at other times, or with left and right exchanged, which in a walk
/// looks like a lag of half a cycle; otherwise "". The truth's first frame is paired with the answer at `start_s`.
/// DoubtsOnPair states what counts as far better.
std::string DoubtOnTimes(const JudgedSide& truth, const JudgedSide& answer, double start_s);

/// Returns a doubt if the answer fits far better with a clock that drifts (by at most 5 %) or jumps once than with any
/// constant shift; otherwise "". Times are searched in steps of a thirtieth of a second, or one frame of the slower
/// file.
std::string DoubtOnClock(const JudgedSide& truth, const JudgedSide& answer, double start_s);

}  // namespace etude
