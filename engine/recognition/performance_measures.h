#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "engine/recognition/alignment.h"
#include "engine/recognition/pose_vector.h"

namespace etude {

/// Measures of the timing of a performance relative to the window in which it was asked for. The steps since the window
/// opened are compared with the example shifted in time as a whole, without warping. A warped path would hide a delay
/// in the middle of a performance, and a move that repeats itself can be aligned anywhere.
struct ClockMeasures {
  double shift = 0;   ///< delay, in seconds, at which the example fits best
  double first = 0;   ///< the same delay for the first half of the example
  double second = 0;  ///< the same delay for the second half of the example
  double drift = 0;   ///< second − first
  /// `off` is the root mean squared distance at the performer's usual shift. A gain is the amount by which the best
  /// shift lowers this distance: `gain` for the whole example, `first_gain` for its first half, `second_gain` for its
  /// second half.
  double off = 0, gain = 0, first_gain = 0, second_gain = 0;

  std::array<double, 8> All() const { return {shift, first, second, drift, off, gain, first_gain, second_gain}; }
};
constexpr std::size_t kClockMeasures = 8;

/// Computes ClockMeasures step by step.
class ClockComparison {
 public:
  /// `pattern` is the example, in parts of kLimbs. It must outlive this object.
  explicit ClockComparison(std::span<const PoseVector> pattern);

  /// Takes the next step of the window.
  void Update(const PoseVector& seen);
  /// Returns the measures of the steps so far. `usual_s` is the performer's usual shift, seconds.
  ClockMeasures Measure(double usual_s) const;

 private:
  static constexpr int kMaxSteps = 24;  ///< the largest shift: 1.6 s, about a beat of a slow move
  struct ShiftSum {
    double distance = 0;
    int count = 0;
    ShiftSum operator+(const ShiftSum& other) const { return {distance + other.distance, count + other.count}; }
  };
  struct Fit {
    double shift_s = 0, off = 0, gain = 0;
  };
  enum class Part { kWhole, kFirst, kSecond };
  ShiftSum SumOf(Part part, int shift) const;
  Fit FitOf(Part part, double usual_s) const;

  std::span<const PoseVector> pattern_;
  int count_ = 0;                                                    ///< number of steps seen
  std::array<std::array<ShiftSum, 2 * kMaxSteps + 1>, 2> halves_{};  ///< one sum per half of the example and per shift
};

/// The number of measures of RigidComparison: 36 measures of the limbs, as for a warped path, then the lag in
/// seconds, the logarithm of the pace (below 0: faster than taught), the distance, the distance at the taught pace
/// (with a small penalty on the lag), and the share of the example that was seen. The distances are −1 if nothing
/// fits.
constexpr std::size_t kRigidMeasures = 41;

/// Compares, limb by limb, the example with the steps since the window opened. The example is shifted and stretched in
/// time as a whole, by the lag and pace that fit best. Parts of a performance that come too early or too late remain
/// errors.
class RigidComparison {
 public:
  /// `pattern` is the example, in parts of kLimbs. It must outlive this object.
  explicit RigidComparison(std::span<const PoseVector> pattern) : pattern_(pattern), distances_(pattern.size()) {}

  /// Takes the next step of the window.
  void Update(const PoseVector& seen);
  /// Returns the measures of the steps so far. `usual_s` is the performer's usual shift, seconds; of two equally good
  /// fits, the one nearer to `usual_s` is taken.
  std::array<double, kRigidMeasures> Measure(double usual_s) const;

 private:
  static constexpr std::array<double, 5> kPaces = {0.75, 0.87, 1, 1.15, 1.32};  ///< durations relative to the example's
  static constexpr std::size_t kTaughtPace = 2;
  static constexpr int kEarliest = -6, kLatest = 24;  ///< the range of lags, in steps
  struct Sum {
    double distance = 0;
    int count = 0;
  };
  /// Returns the taught step that corresponds to a seen step; it may lie outside of the pattern.
  static int TaughtAt(int seen, std::size_t pace, int lag);

  std::span<const PoseVector> pattern_;
  std::vector<double> distances_;  ///< distance from the last seen step to each step of the pattern
  std::vector<PoseVector> seen_;   ///< seen steps, up to the last one that can match the pattern
  std::array<std::array<Sum, kLatest - kEarliest + 1>, kPaces.size()> sums_{};
};

/// Consecutive measures of a performance: the index of the first one and their number.
struct MeasureSlice {
  std::size_t first = 0, count = 0;

  constexpr std::size_t end() const { return first + count; }
  /// Returns the slice after this one, of the same length: the differences of these measures from the person's usual
  /// values.
  constexpr MeasureSlice Beyond() const { return {end(), count}; }
};

/// The indices of a performance's measures. Trained models refer to measures by index. If you add, move or remove a
/// measure, increase kMeasuresVersion and train the shipped models again (`etude train --recogniser`).
constexpr int kMeasuresVersion = 1;
/// For each limb: the error, the error after the limb's mean direction is corrected, and the missing share of the
/// limb's amplitude. For a left and a right limb, the larger value comes first.
constexpr MeasureSlice kLimbMeasures{0, 36};
/// The square root of the path's cost (for the whole example, then for each third of the example), the error of the
/// worst limb, and the mean error of the limbs.
constexpr MeasureSlice kDistanceMeasures{kLimbMeasures.end(), 6};
/// Lag, stretch, unsteadiness and largest timing error of the path.
constexpr MeasureSlice kPathClockMeasures{kDistanceMeasures.end(), 4};
/// The path's cost divided by the sum of the path's cost and the cost of the nearest other move.
constexpr MeasureSlice kOtherMoveMeasure{kPathClockMeasures.end(), 1};
/// The four slices above together: the measures of one performance against one example of any move.
constexpr MeasureSlice kOwnMeasures{0, kOtherMoveMeasure.end()};
/// The timing relative to the window (ClockMeasures); 0 if the performance was not asked for.
constexpr MeasureSlice kClockSlice{kOwnMeasures.Beyond().end(), kClockMeasures};
/// The comparison with an example that is shifted and stretched as a whole (RigidComparison); 0 if the performance was
/// not asked for.
constexpr MeasureSlice kRigidSlice{kClockSlice.Beyond().end(), kRigidMeasures};
constexpr std::size_t kMeasureCount = kRigidSlice.Beyond().end();
constexpr std::size_t kDistanceMeasure = kDistanceMeasures.first;
using PerformanceMeasures = std::array<double, kMeasureCount>;

/// A performance that was aligned with an example.
struct AlignedPerformance {
  std::span<const StepPair> path;              ///< at least one pair
  std::function<const PoseVector&(int)> seen;  ///< returns the pose with index StepPair::seen, in parts of kLimbs
  std::span<const PoseVector> pattern;         ///< the example, in parts of kLimbs
  double cost = 0;                             ///< the path's cost (SubsequenceAligner::Cost)
  /// The lowest cost of another move in the last second; infinite if no other move has a path.
  double other_cost = 0;
};

/// Measures a performance. Leaves two kinds of measures at 0: the differences from the person's usual measures
/// (PersonBaseline fills them in), and the comparisons with the window (kClockSlice, kRigidSlice).
PerformanceMeasures Measure(const AlignedPerformance& performance);

/// Keeps the usual measures of a person: the medians over their performances so far. People differ in amplitude and
/// delay, so a fault is a difference from the person's own usual measures.
class PersonBaseline {
 public:
  /// Adds a performance, right or wrong. Only the latest 32 count.
  void Add(const PerformanceMeasures& performance);
  /// Fills in the differences from the performer's usual measures.
  void Relate(PerformanceMeasures& performance) const;
  /// Returns the performer's usual delay relative to the window, in seconds.
  double Shift() const;

 private:
  std::vector<PerformanceMeasures> latest_;
  PerformanceMeasures usual_{};
};

}  // namespace etude
