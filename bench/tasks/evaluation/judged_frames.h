#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/metrics/time_shift.h"
#include "bench/tasks/evaluation/common_joints.h"
#include "engine/motion/raw_motion.h"

namespace etude {

/// Returns true if the two frame rates count as equal: at the truth's end, the times of frames of equal number differ
/// by less than a hundredth of a frame. Files may state their rates with rounding.
bool HaveSameRate(const RawMotion& truth, const RawMotion& answer);

/// The time from the truth's first frame to the answer's, by the clocks that their files state.
struct StatedOffset {
  double seconds = 0;
  std::string note;
};

/// Compares the clocks that both files state. If a file states none, or if the clocks never show the same time, the
/// first frames count as simultaneous. If the rates are equal and the offset is within a tenth of a frame of a whole
/// number of frames, it is rounded to this number.
StatedOffset OffsetOf(const RawMotion& truth, const RawMotion& answer);

/// Finds the lag of the answer (FindTimeShift) that remains if the truth's first frame is paired with the answer at
/// `start_s`, as the clocks of both files state.
std::optional<TimeShift> FindLag(const JudgedSide& truth, const JudgedSide& answer, double start_s);

/// The frames at which an answer is judged, in frames of the answer (whole numbers, which may lie outside of it) and in
/// frames of the truth.
struct JudgedFrames {
  std::vector<double> of_answer, of_truth;
  std::vector<double> own;  ///< all frames of the answer within the truth, if more than are judged; else empty
  double rate_hz = 0;
  bool is_interpolated = false;  ///< true: the truth has no frame at one of these times
  bool is_even = true;           ///< true: the answer's frames follow each other at equal steps
};

/// Returns the frames at which the answer is judged (Match). The truth's first frame is at `start_s` of the answer.
JudgedFrames FramesToJudge(const RawMotion& truth, const RawMotion& answer, double start_s);

}  // namespace etude
