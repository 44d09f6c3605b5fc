#include "engine/transitions/choices/fuzzy_window_rows.h"

#include <algorithm>

namespace etude {

FuzzyWindowRows::FuzzyWindowRows(std::span<const Grades> playing, std::span<const Grades> next, int first_leave_frame,
                                 int reach, const FeatureWeights& weights)
    : playing_(playing),
      next_frames_(static_cast<int>(next.size())),
      reach_(reach),
      rows_(next, weights),
      distances_(std::max(first_leave_frame - reach, 0), next_frames_, 2 * reach + 2) {}

void FuzzyWindowRows::Compute(int leave_frame, std::span<const int> enter_frames, std::span<double> costs) {
  const int playing_frames = static_cast<int>(playing_.size());
  while (distances_.NextRow() <= std::min(leave_frame + reach_, playing_frames - 1)) {
    const std::span<double> row = distances_.OpenRow();
    rows_.Compute(playing_[distances_.NextRow()], row);
    distances_.CloseRow();
  }
  for (std::size_t i = 0; i < enter_frames.size(); ++i) {
    const int enter = enter_frames[i];
    const Reach around = ReachAround(leave_frame, playing_frames, enter, next_frames_, reach_);
    const double sum = distances_.SumEndingAt(leave_frame + around.after, enter + around.after, around.Count());
    costs[i] = sum / around.Count();
  }
}

}  // namespace etude
