#pragma once

#include <span>

#include "engine/transitions/choices/diagonal_sums.h"
#include "engine/transitions/choices/fuzzy_rows.h"
#include "engine/transitions/choices/pair_rows.h"

namespace etude {

/// The mean of equation 1's distance over the frames around each pair of a row, `reach` to each side as far as both
/// motions go: two frames are compared once, not once per window.
class FuzzyWindowRows : public PairRows {
 public:
  /// Rows begin at `first_leave_frame`; the playing clip's grades must outlive this.
  FuzzyWindowRows(std::span<const Grades> playing, std::span<const Grades> next, int first_leave_frame, int reach,
                  const FeatureWeights& weights);
  void Compute(int leave_frame, std::span<const int> enter_frames, std::span<double> costs) override;

 private:
  std::span<const Grades> playing_;
  int next_frames_, reach_;
  FuzzyRows rows_;
  DiagonalSums<double> distances_;
};

}  // namespace etude
