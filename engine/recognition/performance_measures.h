#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "engine/recognition/alignment.h"
#include "engine/recognition/pose_vector.h"

namespace etude {

/// Measures of how a performance keeps time with whoever asks for it: what is seen since the window opened is compared
/// with an example that is shifted in time as a whole, never warped. A warped path hides who is late in the middle; and
/// a move that repeats itself fits anywhere.
struct ClockMeasures {
  double shift = 0;   ///< seconds by which the example must come later to fit best
  double first = 0;   ///< likewise of the example's first half alone
  double second = 0;  ///< of its second half
  double drift = 0;   ///< second − first
  /// Root mean squared distance at the shift that is usual of this person, and by how much that falls where the example
  /// is moved: all of it, its first half, its second.
  double off = 0, gain = 0, first_gain = 0, second_gain = 0;

  std::array<double, 8> All() const { return {shift, first, second, drift, off, gain, first_gain, second_gain}; }
};
constexpr std::size_t kClockMeasures = 8;

/// Gathers the measures step by step.
class ClockComparison {
 public:
  /// Compares with `pattern`, of limbs, which must outlive this.
  explicit ClockComparison(std::span<const PoseVector> pattern);

  /// Takes the next step since the window opened.
  void Update(const PoseVector& seen);
  /// Measures the steps so far. `usual_s` is the shift that is usual of this person.
  ClockMeasures Measure(double usual_s) const;

 private:
  static constexpr int kMaxSteps = 24;  ///< 1.6 s: a beat of a slow move
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
  int count_ = 0;                                                     ///< steps seen
  std::array<std::array<ShiftSum, 2 * kMaxSteps + 1>, 2> halves_{};  ///< of the example, by shift
};

/// The limbs' measures as of a warped path (36), then lag in seconds, logarithm of the pace (below 0: faster than
/// taught), distance, distance at the taught pace, and the share of the example that was seen.
constexpr std::size_t kRigidMeasures = 41;

/// Lays what is seen from the window's opening on on an example that is moved and stretched in time as a whole: at the
/// lag and pace that fit best, limb by limb. What is done too early or too late on the way stays an error.
class RigidComparison {
 public:
  /// Compares with `pattern`, of limbs, which must outlive this.
  explicit RigidComparison(std::span<const PoseVector> pattern) : pattern_(pattern), distances_(pattern.size()) {}

  /// Takes the next step since the window opened.
  void Update(const PoseVector& seen);
  /// Measures the steps so far. `usual_s` is the shift that is usual of this person: of fits alike the nearer counts.
  std::array<double, kRigidMeasures> Measure(double usual_s) const;

 private:
  static constexpr std::array<double, 5> kPaces = {0.75, 0.87, 1, 1.15, 1.32};  ///< times the example's length
  static constexpr std::size_t kTaughtPace = 2;
  static constexpr int kEarliest = -6, kLatest = 24;  ///< steps
  struct Sum {
    double distance = 0;
    int count = 0;
  };
  /// Returns the step taught that goes with a step seen; outside the pattern: none does.
  static int TaughtAt(int seen, std::size_t pace, int lag);

  std::span<const PoseVector> pattern_;
  std::vector<double> distances_;  ///< of the step seen last
  std::vector<PoseVector> seen_;   ///< as many as can matter
  std::array<std::array<Sum, kLatest - kEarliest + 1>, kPaces.size()> sums_{};
};

/// Neighbouring measures of a performance, by their places.
struct MeasureSlice {
  std::size_t first = 0, count = 0;

  constexpr std::size_t end() const { return first + count; }
  /// The next slice, equally large: how far each measure is beyond the person's usual.
  constexpr MeasureSlice Beyond() const { return {end(), count}; }
};

/// The places of a performance's measures. Models that were learnt name measures by place: whoever moves, adds or takes
/// one raises kMeasuresVersion, and the shipped models are trained anew (`etude train --recogniser`).
constexpr int kMeasuresVersion = 1;
/// Per limb how far it is off, how far once its mean direction is forgiven, and what share of its amplitude is missing;
/// left and right as the larger and the smaller of both.
constexpr MeasureSlice kLimbMeasures{0, 36};
/// The root of the path's cost, then of each third of the example; the worst limb, the mean limb.
constexpr MeasureSlice kDistanceMeasures{kLimbMeasures.end(), 6};
/// Lag, stretch, unsteadiness and worst moment of the path.
constexpr MeasureSlice kPathClockMeasures{kDistanceMeasures.end(), 4};
/// The path's cost as a share of it and of the nearest other move's.
constexpr MeasureSlice kOtherMoveMeasure{kPathClockMeasures.end(), 1};
/// All four, of one performance against one example, of any move.
constexpr MeasureSlice kOwnMeasures{0, kOtherMoveMeasure.end()};
/// How the performance keeps to the clock of who asks for it (ClockMeasures); 0 for what nobody asked for.
constexpr MeasureSlice kClockSlice{kOwnMeasures.Beyond().end(), kClockMeasures};
/// How the performance lies on an example that is moved and stretched in time as a whole (RigidComparison); likewise.
constexpr MeasureSlice kRigidSlice{kClockSlice.Beyond().end(), kRigidMeasures};
constexpr std::size_t kMeasureCount = kRigidSlice.Beyond().end();
constexpr std::size_t kDistanceMeasure = kDistanceMeasures.first;
using PerformanceMeasures = std::array<double, kMeasureCount>;

/// A performance as it went along an example.
struct AlignedPerformance {
  std::span<const StepPair> path;              ///< at least one pair
  std::function<const PoseVector&(int)> seen;  ///< by StepPair::seen; limbs
  std::span<const PoseVector> pattern;         ///< limbs
  double cost = 0;                             ///< of the path (SubsequenceAligner::Cost)
  double other_cost = 0;                       ///< of the nearest other move lately; infinite: of none
};

/// Measures a performance. The measures beyond the usual are left 0 (PersonBaseline fills them in), and so are those of
/// the clock.
PerformanceMeasures Measure(const AlignedPerformance& performance);

/// Keeps what is usual of a person: the medians of the measures of their performances so far. People differ in how far
/// they swing and how late they are; a fault is what they do not do otherwise.
class PersonBaseline {
 public:
  /// Adds a performance, right or not; the latest 32 count.
  void Add(const PerformanceMeasures& performance);
  /// Fills in what is beyond the usual.
  void Relate(PerformanceMeasures& performance) const;
  /// Returns the shift by which this person keeps the clock, seconds: by how much windows open too late for them.
  double Shift() const;

 private:
  std::vector<PerformanceMeasures> latest_;
  PerformanceMeasures usual_{};
};

}  // namespace etude
