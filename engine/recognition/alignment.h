#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/recognition/pose_vector.h"

namespace etude {

/// A step seen and the step taught that it goes with.
struct StepPair {
  int seen = 0;    ///< counted from the first that the aligner saw since its reset
  int taught = 0;  ///< index in the pattern
};

/// Runs subsequence dynamic time warping step by step (Müller 2007, section 4.4, with his slope condition of at most
/// 2): the path through all of a pattern that ends in the step seen last, wherever it began. Every step seen costs its
/// distance, every step of the pattern that was passed over, too.
class SubsequenceAligner {
 public:
  /// Aligns with `pattern`, which has at least one step and must outlive this. A path of more than `longest` ≥ 1 steps
  /// seen is dropped, with those that it was better than.
  SubsequenceAligner(std::span<const PoseVector> pattern, int longest);

  void Reset();
  void Update(const PoseVector& seen);

  /// The cost of the best path that ends now, per step of the pattern: a mean squared distance. Infinite where no path
  /// reaches the pattern's end yet.
  double Cost() const { return costs_.back() / static_cast<double>(pattern_.size()); }
  /// The best path that ends now, in order of time; none where Cost is infinite.
  std::vector<StepPair> Path() const;

 private:
  std::span<const PoseVector> pattern_;
  int longest_;
  int count_ = 0;  // steps seen
  std::vector<double> costs_, distances_;
  std::vector<int> starts_;             // per step of the pattern: where the best path to it began
  std::vector<std::uint8_t> advances_;  // per step seen (a ring of `longest_`) and step of the pattern: 0, 1 or 2
};

}  // namespace etude
