// This file is compiled once for every vector instruction set of x86-64 CPUs; the best version is chosen at run time
// (engine/kinematics/solvers/README.md explains why Highway is used).
#include "engine/transitions/search/grade_blocks.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/transitions/search/grade_blocks.cc"
#include "hwy/foreach_target.h"  // must come before highway.h

// This header must be included after foreach_target.h.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, kBlockLanes / 2>;
using Vec = hn::Vec<Tag>;

/// Sums up weighted squared differences in the order of `ComputeDistance`. `gap(term, lane)` returns the differences in
/// a term for the vector of lanes that begins at `lane`. MulAdd is not used: it rounds once, while CPUs without it
/// round twice. The function stops when all lanes exceed the limit, because the sums never decrease.
template <class Gap>
HWY_INLINE BlockResult SumSquares(const GradeMetric& metric, double limit, const Gap& gap) {
  const Tag tag;
  const std::size_t lanes = hn::Lanes(tag);
  const Vec max = hn::Set(tag, limit);
  Vec least = max;
  BlockResult result;
  // Process two vectors at a time: two independent sums hide the latency of the additions.
  for (std::size_t lane = 0; lane < kBlockLanes; lane += 2 * lanes) {
    Vec sum_a = hn::Zero(tag), sum_b = hn::Zero(tag);
    bool is_open = true;
    for (std::size_t k = 0; k < kFeatureCount && is_open; ++k) {
      Vec feature_a = hn::Zero(tag), feature_b = hn::Zero(tag);
      for (std::size_t t = metric.first_term[k]; t < metric.first_term[k + 1]; ++t) {
        const Vec gap_a = gap(t, lane), gap_b = gap(t, lane + lanes);
        feature_a = hn::Add(feature_a, hn::Mul(gap_a, gap_a));
        feature_b = hn::Add(feature_b, hn::Mul(gap_b, gap_b));
      }
      // Add the weighted feature. After every second feature, check whether all lanes exceed the limit.
      const Vec weight = hn::Set(tag, metric.weights[k]);
      sum_a = hn::Add(sum_a, hn::Mul(weight, feature_a));
      sum_b = hn::Add(sum_b, hn::Mul(weight, feature_b));
      if (k % 2 == 1) is_open = !hn::AllFalse(tag, hn::Or(hn::Le(sum_a, max), hn::Le(sum_b, max)));
    }
    if (!is_open) continue;
    // Store the sums and the mask of the lanes within the limit.
    least = hn::Min(least, hn::Min(sum_a, sum_b));
    hn::Store(sum_a, tag, &result.squared[lane]);
    hn::Store(sum_b, tag, &result.squared[lane + lanes]);
    std::array<std::uint8_t, 8> bits{};
    hn::StoreMaskBits(tag, hn::Le(sum_a, max), bits.data());
    result.kept |= static_cast<std::uint32_t>(bits[0]) << lane;
    hn::StoreMaskBits(tag, hn::Le(sum_b, max), bits.data());
    result.kept |= static_cast<std::uint32_t>(bits[0]) << (lane + lanes);
  }
  result.least = hn::GetLane(hn::MinOfLanes(tag, least));
  return result;
}

BlockResult Distances(const GradeMetric& metric, const Grades& query, const FrameBlock& block, double limit) {
  const Tag tag;
  return SumSquares(metric, limit, [&](std::size_t t, std::size_t lane) HWY_ATTR {
    return hn::Sub(hn::Load(tag, &block.grades[t][lane]), hn::Set(tag, query[t]));
  });
}

BlockResult Bounds(const GradeMetric& metric, const GradeBox& query, const BoxBlock& block, double limit) {
  const Tag tag;
  const hn::Rebind<float, Tag> stored;
  return SumSquares(metric, limit, [&](std::size_t t, std::size_t lane) HWY_ATTR {
    const Vec low = hn::PromoteTo(tag, hn::Load(stored, &block.low[t][lane]));
    const Vec high = hn::PromoteTo(tag, hn::Load(stored, &block.high[t][lane]));
    const Vec below = hn::Sub(low, hn::Set(tag, query.high[t]));
    const Vec above = hn::Sub(hn::Set(tag, query.low[t]), high);
    return hn::Max(hn::Max(below, above), hn::Zero(tag));
  });
}

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace etude {

HWY_EXPORT(Distances);
HWY_EXPORT(Bounds);

GradeMetric::GradeMetric(const FeatureWeights& feature_weights) : weights(feature_weights) {
  // Negative weights are not allowed: SumSquares stops early because partial sums never decrease.
  for ([[maybe_unused]] double weight : weights) assert(weight >= 0);
  for (std::size_t k = 0; k < kFeatureCount; ++k) first_term[k] = FirstTermOf(AllFeatures()[k]);
  first_term[kFeatureCount] = kTermCount;
}

void FrameBlock::Set(int lane, const Grades& frame) {
  for (std::size_t t = 0; t < kTermCount; ++t) grades[t][lane] = frame[t];
}

void GradeBox::Include(const GradeBox& other) {
  for (std::size_t t = 0; t < kTermCount; ++t) {
    low[t] = std::min(low[t], other.low[t]);
    high[t] = std::max(high[t], other.high[t]);
  }
}

GradeBox BoxOf(std::span<const Grades> frames) {
  GradeBox box{frames[0], frames[0]};
  for (const Grades& grades : frames) box.Include({grades, grades});
  return box;
}

void BoxBlock::Set(int lane, const GradeBox& box) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (std::size_t t = 0; t < kTermCount; ++t) {
    const float nearest_low = static_cast<float>(box.low[t]), nearest_high = static_cast<float>(box.high[t]);
    low[t][lane] = nearest_low <= box.low[t] ? nearest_low : std::nextafter(nearest_low, -kInfinity);
    high[t][lane] = nearest_high >= box.high[t] ? nearest_high : std::nextafter(nearest_high, kInfinity);
  }
}

BlockResult SquaredDistances(const GradeMetric& metric, const Grades& query, const FrameBlock& block, double limit) {
  return HWY_DYNAMIC_DISPATCH(Distances)(metric, query, block, limit);
}

BlockResult SquaredBounds(const GradeMetric& metric, const GradeBox& query, const BoxBlock& block, double limit) {
  return HWY_DYNAMIC_DISPATCH(Bounds)(metric, query, block, limit);
}

double SquaredLimit(double distance) {
  // The slack covers the rounding of the square root and of the square, each by at most half a unit in the last place,
  // or by the smallest denormal near zero.
  constexpr double kSlack = 1 + 4 * std::numeric_limits<double>::epsilon();
  return distance * distance * kSlack + std::numeric_limits<double>::denorm_min();
}

}  // namespace etude
#endif  // HWY_ONCE
