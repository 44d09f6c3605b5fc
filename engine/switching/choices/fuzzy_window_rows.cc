#include "engine/switching/choices/fuzzy_window_rows.h"

#include <algorithm>
#include <cmath>

namespace etude {

FuzzyWindowRows::FuzzyWindowRows(std::span<const Grades> playing, std::span<const Grades> next, int first_leave_frame,
                                 int half, const FeatureWeights& weights)
    : playing_(playing),
      next_frames_(static_cast<int>(next.size())),
      half_(half),
      rows_(next, weights),
      distances_(std::max(first_leave_frame - half, 0), next_frames_, 2 * half + 2) {}

void FuzzyWindowRows::Compute(int leave_frame, std::span<double> costs) {
  const int playing_frames = static_cast<int>(playing_.size());
  while (distances_.NextRow() <= std::min(leave_frame + half_, playing_frames - 1)) {
    const std::span<double> row = distances_.OpenRow();
    rows_.Compute(playing_[distances_.NextRow()], row);
    for (double& square : row) square = std::sqrt(square);
    distances_.CloseRow();
  }
  for (int enter = 0; enter < static_cast<int>(costs.size()); ++enter) {
    const Reach reach = ReachAround(leave_frame, playing_frames, enter, next_frames_, half_);
    const double sum = distances_.SumEndingAt(leave_frame + reach.after, enter + reach.after, reach.Count());
    costs[enter] = sum / reach.Count();
  }
}

}  // namespace etude
