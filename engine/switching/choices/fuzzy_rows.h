#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/fuzzy/distance.h"

namespace etude {

/// d² of equation 1 from one frame to many, side by side: to the last bit what ComputeDistance adds up.
class FuzzyRows {
 public:
  FuzzyRows(std::span<const Grades> frames, const FeatureWeights& weights);

  /// The squares of the distances from `grades` to the first frames, as many as `squares` has room for.
  void Compute(const Grades& grades, std::span<double> squares) const;

 private:
  /// Frames are compared four at a time, which the compiler turns into vector instructions.
  static constexpr std::size_t kLanes = 4;
  using Block = std::array<std::array<double, kLanes>, kTermCount>;
  std::vector<Block> blocks_;
  FeatureWeights weights_;
};

}  // namespace etude
