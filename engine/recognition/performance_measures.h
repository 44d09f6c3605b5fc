#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/recognition/alignment.h"

namespace etude {

/// What is measured of one performance against one example, of whatever move: per limb how far it is off, how far once
/// its mean direction is forgiven, and what share of its amplitude is missing; left and right as the larger and the
/// smaller of both; the clock; the nearest other move.
constexpr std::size_t kMeasureCount = 43;
using PerformanceMeasures = std::array<double, kMeasureCount>;

/// Their names, for people, in their order.
const std::vector<std::string>& MeasureNames();

/// A performance as it went along an example.
struct AlignedPerformance {
  std::span<const StepPair> path;              ///< at least one pair
  std::function<const PoseVector&(int)> seen;  ///< by StepPair::seen; limbs
  std::span<const PoseVector> pattern;         ///< limbs
  double cost = 0;                             ///< of the path (SubsequenceAligner::Cost)
  double other_cost = 0;                       ///< of the nearest other move lately; infinite: of none
};

PerformanceMeasures Measure(const AlignedPerformance& performance);

}  // namespace etude
