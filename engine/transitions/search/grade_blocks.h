#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "engine/fuzzy/distance.h"

namespace etude {

/// The number of frames, or of boxes of frames, that are compared together.
constexpr int kBlockLanes = 16;
using BlockLanes = std::array<double, kBlockLanes>;

/// The membership grades of sixteen frames. For vector instructions, the sixteen grades of one fuzzy term are adjacent
/// in memory.
struct alignas(64) FrameBlock {
  std::array<BlockLanes, kTermCount> grades{};

  void Set(int lane, const Grades& frame);
};

/// For each fuzzy term: the smallest and the largest membership grade in a set of frames.
struct GradeBox {
  Grades low{}, high{};

  void Include(const GradeBox& other);
};
/// Returns the box of these frames. There must be at least one frame.
GradeBox BoxOf(std::span<const Grades> frames);

/// Sixteen boxes. For each fuzzy term, the smallest grades of the sixteen boxes are adjacent in memory. The largest
/// grades are stored in the same way. The boxes are rounded outwards to single precision, because reading the boxes
/// dominates the cost of a search.
struct alignas(64) BoxBlock {
  using Lanes = std::array<float, kBlockLanes>;
  std::array<Lanes, kTermCount> low{}, high{};

  void Set(int lane, const GradeBox& box);
};

/// Returns the number of blocks for `count` frames.
constexpr int BlocksFor(std::size_t count) { return static_cast<int>((count + kBlockLanes - 1) / kBlockLanes); }
/// Returns a bit mask of a block's used lanes. `count` is the number of frames from the block's first lane on.
constexpr std::uint32_t LanesOf(int count) { return count >= kBlockLanes ? 0xffff : (1u << count) - 1; }

/// The constants of paper A's equation 1: the terms and the weight of each feature.
struct GradeMetric {
  /// Makes the metric from weights, which must be ≥ 0.
  explicit GradeMetric(const FeatureWeights& feature_weights);

  FeatureWeights weights;
  /// Feature k has the terms first_term[k] … first_term[k + 1] − 1.
  std::array<std::size_t, kFeatureCount + 1> first_term{};
};

/// The squares of sixteen distances, and a mask of the lanes whose square is within the limit.
struct BlockResult {
  alignas(64) BlockLanes squared;  ///< valid for the lanes in `kept`; the other sums may be incomplete
  std::uint32_t kept = 0;          ///< bit i is set if d² in lane i is at most the limit
  double least = 0;                ///< no lane, kept or not, has a smaller d²; at most the limit
};

/// Calls `visit` with the index of each set bit, the lowest first.
template <class Visit>
void ForEachLane(std::uint32_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(std::countr_zero(bits));
}

/// Returns d² between `query` and every frame of the block. On every CPU, d² equals, bit for bit, the sum of which
/// `ComputeDistance` takes the square root.
BlockResult SquaredDistances(const GradeMetric& metric, const Grades& query, const FrameBlock& block, double limit);

/// For each box (rounded outwards), returns a lower bound of d² between any frame in `query` and any frame in the box.
/// The bound never exceeds d² as `ComputeDistance` rounds it, because the two functions use the same operations in the
/// same order, and rounding is monotonic.
BlockResult SquaredBounds(const GradeMetric& metric, const GradeBox& query, const BoxBlock& block, double limit);

/// Returns a limit for d²: if a frame's rounded distance is at most `distance`, its d² never exceeds the limit.
double SquaredLimit(double distance);

}  // namespace etude
