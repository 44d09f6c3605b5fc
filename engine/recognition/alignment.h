#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/recognition/pose_vector.h"

namespace etude {

/// A pair of time steps that the alignment matches.
struct StepPair {
  int seen = 0;    ///< index of the seen step since the aligner's last Reset
  int taught = 0;  ///< index of the taught step in the pattern
};

/// Runs subsequence dynamic time warping online, one step per Update (Müller 2007, section 4.4, with the slope
/// condition of at most 2). A path matches the whole pattern, may begin at any seen step, and ends at the last seen
/// step. The cost of a path is a sum of squared distances: of each seen step to its pattern step, and of each skipped
/// pattern step to the seen step after the skip.
class SubsequenceAligner {
 public:
  /// Aligns with `pattern`, which must have at least one step and outlive this object. A path longer than `longest` ≥ 1
  /// seen steps is dropped; worse paths that it had replaced are not restored.
  SubsequenceAligner(std::span<const PoseVector> pattern, int longest);

  /// Forgets all steps seen so far.
  void Reset();
  /// Takes the next seen step.
  void Update(const PoseVector& seen);

  /// Returns the cost of the best path that ends at the last seen step, divided by the number of pattern steps: a mean
  /// squared distance. Returns infinity while no path reaches the pattern's end.
  double Cost() const { return costs_.back() / static_cast<double>(pattern_.size()); }
  /// Returns the best path that ends at the last seen step, in order of time; an empty list if Cost is infinite.
  std::vector<StepPair> Path() const;

 private:
  std::span<const PoseVector> pattern_;
  int longest_;
  int count_ = 0;  // number of seen steps
  std::vector<double> costs_, distances_;
  std::vector<int> starts_;  // for each pattern step, the seen step at which the best path to it began
  // For each seen step (only the last `longest_`, as a ring) and pattern step: the number of pattern steps by which the
  // best path advances to get there, 0, 1 or 2, or kBegins.
  std::vector<std::uint8_t> advances_;
};

}  // namespace etude
