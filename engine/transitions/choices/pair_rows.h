#pragma once

#include <span>

#include "engine/transitions/base/transition_record.h"
#include "engine/transitions/bridge_frames/transition_points.h"
#include "engine/transitions/library/library.h"

namespace etude {

/// The pairs of frames that a choice may take: every frame of the playing clip in `leave` × every frame of the wanted
/// clip before `enter_end`. One row of pairs belongs to each frame that may be left.
struct PairRange {
  FrameWindow leave;
  int enter_end = 0;

  int Rows() const { return leave.last - leave.first + 1; }
};

/// All pairs that budget and `rules.least_play_s` allow; one at least when the wanted clip has two frames.
PairRange AllowedPairs(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules);

/// What one kind of cost says of the pairs of a row. Rows are asked for in rising order.
class PairRows {
 public:
  virtual ~PairRows() = default;
  /// The costs of leaving at `leave_frame` and entering at each of `enter_frames`; `costs` has as many places.
  virtual void Compute(int leave_frame, std::span<const int> enter_frames, std::span<double> costs) = 0;
};

}  // namespace etude
