#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/recognition/alignment.h"
#include "engine/recognition/clock_measures.h"

namespace etude {

/// What is measured of one performance against one example, of whatever move: per limb how far it is off, how far once
/// its mean direction is forgiven, and what share of its amplitude is missing; left and right as the larger and the
/// smaller of both; how far the body is off in each third of the example; the clock; the nearest other move.
constexpr std::size_t kOwnMeasures = 47;
constexpr std::size_t kDistanceMeasure = 36;  ///< among them: the root of the path's cost
/// Then the same once more, each beyond what is usual of this person: 0 as long as nothing is known of them. Then how
/// the performance keeps to the clock of who asks for it (ClockMeasures), and that beyond the usual, too: 0 for who
/// does not go by it.
constexpr std::size_t kFirstClockMeasure = 2 * kOwnMeasures;
constexpr std::size_t kMeasureCount = kFirstClockMeasure + 2 * kClockMeasures;
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

/// Those beyond the usual are left 0 (PersonsUsual fills them in), and those of the clock.
PerformanceMeasures Measure(const AlignedPerformance& performance);

/// What is usual of a person: the medians of what was measured of their performances so far. People differ in how far
/// they swing and how late they are; a fault is what they do not do otherwise.
class PersonsUsual {
 public:
  /// One more performance, right or not; the latest 32 count.
  void Add(const PerformanceMeasures& performance);
  /// Fills in what is beyond the usual.
  void Relate(PerformanceMeasures& performance) const;
  /// The shift by which this person keeps the clock, seconds: by how much windows open too late for them.
  double Shift() const;

 private:
  std::vector<PerformanceMeasures> latest_;
  PerformanceMeasures usual_{};
};

}  // namespace etude
