#pragma once

#include <span>
#include <vector>

#include "engine/fuzzy/distance.h"
#include "engine/transitions/search/grade_blocks.h"

namespace etude {

/// Equation 1 from one frame to many, side by side: to the last bit ComputeDistance.
class FuzzyRows {
 public:
  FuzzyRows(std::span<const Grades> frames, const FeatureWeights& weights);

  /// The distances from `grades` to the first frames, as many as `distances` has room for.
  void Compute(const Grades& grades, std::span<double> distances) const;

 private:
  GradeMetric metric_;
  std::vector<FrameBlock> blocks_;
};

}  // namespace etude
