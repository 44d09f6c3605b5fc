#pragma once

#include "bench/model/row.h"
#include "bench/tasks/evaluation/match.h"

namespace etude {

constexpr std::size_t kSegmentFrames = 100;  ///< length of a segment of W-MPJPE and WA-MPJPE
constexpr std::size_t kWindowFrames = 30;    ///< length of a window of NPSS: LAFAN1's gap of one second

/// Returns what an answer was judged on: the joints and the root, the answer's rate, the rate at which it is compared,
/// and for each metric the share of what the truth shows on which the metric was measured. The share counts what the
/// metric needs and the truth has: positions of joints; positions in segments to which an alignment can be fitted;
/// joints in three frames in a row; whole windows of frames that show every joint, and so on. Frames are those at which
/// the answer is judged, so an answer of a lower rate that shows everything has the share 1. For a metric of the answer
/// alone, it is the share of what the answer could show within the truth.
JudgedOn JudgedOf(const MatchedMotions& matched);

}  // namespace etude
