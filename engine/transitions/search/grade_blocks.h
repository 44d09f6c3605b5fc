#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/fuzzy/distance.h"

namespace etude {

/// The number of frames, or boxes of frames, that are compared at once.
constexpr int kBlockLanes = 16;
using BlockLanes = std::array<double, kBlockLanes>;

/// The grades of sixteen frames, term by term, so that one operation serves many of them.
struct alignas(64) FrameBlock {
  std::array<BlockLanes, kTermCount> grades{};

  void Set(int lane, const Grades& frame);
};

/// The least and the greatest grades of frames.
struct GradeBox {
  Grades low{}, high{};

  void Include(const GradeBox& other);
};
/// The box of at least one frame.
GradeBox BoxOf(std::span<const Grades> frames);

/// Sixteen boxes, term by term; rounded outwards to single precision, since reading them is what a search costs.
struct alignas(64) BoxBlock {
  using Lanes = std::array<float, kBlockLanes>;
  std::array<Lanes, kTermCount> low{}, high{};

  void Set(int lane, const GradeBox& box);
};

/// Returns how many blocks `count` frames take.
constexpr int BlocksFor(std::size_t count) { return static_cast<int>((count + kBlockLanes - 1) / kBlockLanes); }
/// The bits of the lanes that a block has when `count` are left from its first one on.
constexpr std::uint32_t LanesOf(int count) { return count >= kBlockLanes ? 0xffff : (1u << count) - 1; }

/// Equation 1 ready to be computed: whose terms are which, and what each feature weighs.
struct GradeMetric {
  /// Makes the metric of weights, none of which may be negative.
  explicit GradeMetric(const FeatureWeights& feature_weights);

  FeatureWeights weights;
  std::array<std::size_t, kFeatureCount + 1> first_term{};  ///< terms first_term[k] … first_term[k + 1] are feature k's
};

/// The squares of sixteen distances, and which of them count.
struct BlockResult {
  alignas(64) BlockLanes squared;  ///< of the lanes in `kept`; others are not finished
  std::uint32_t kept = 0;          ///< bit i: lane i is at most the limit
  double least = 0;                ///< no lane is less, be it kept or not; at most the limit
};

/// Calls `visit` with each lane of the bits, the lowest first.
template <class Visit>
void ForEachLane(std::uint32_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(std::countr_zero(bits));
}

/// Returns d² of `query` and every frame of the block: the very bits that `ComputeDistance` takes the root of, on every
/// CPU.
BlockResult SquaredDistances(const GradeMetric& metric, const Grades& query, const FrameBlock& block, double limit);

/// The least d² that any frame of `query` can have from any frame of each box (rounded outwards). It is never greater
/// than the d² of such a pair as `ComputeDistance` rounds it: both are made by the same operations in the same order,
/// and rounding keeps order.
BlockResult SquaredBounds(const GradeMetric& metric, const GradeBox& query, const BoxBlock& block, double limit);

/// A limit on d² that no frame exceeds whose rounded distance is at most `distance`.
double SquaredLimit(double distance);

/// Every kind of vectors that this CPU has, the best first, and the choice of one of them (any other name: of the
/// best): for tests and benchmarks.
std::vector<std::string> BlockTargets();
void SetBlockTarget(const std::string& target);

}  // namespace etude
