#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/recognition/pose_vector.h"

namespace etude {

/// How a performance keeps to the clock of who asks for it: what is seen from the window's opening on, laid on an
/// example that is moved in time as a whole and never warped. A warped path hides who is late in the middle; and a move
/// that repeats itself fits anywhere.
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

/// Gathers them step by step.
class ClockComparison {
 public:
  /// `pattern` must outlive this; limbs.
  explicit ClockComparison(std::span<const PoseVector> pattern);

  /// The next step since the window opened.
  void Update(const PoseVector& seen);
  /// As things stand. `usual_s`: the shift that is usual of this person.
  ClockMeasures Measure(double usual_s) const;

 private:
  static constexpr int kMostSteps = 24;  ///< 1.6 s: a beat of a slow move
  struct Sum {
    double distance = 0;
    int count = 0;
    Sum operator+(const Sum& other) const { return {distance + other.distance, count + other.count}; }
  };
  struct Fit {
    double shift_s = 0, off = 0, gain = 0;
  };
  enum class Part { kWhole, kFirst, kSecond };
  Sum SumOf(Part part, int shift) const;
  Fit FitOf(Part part, double usual_s) const;

  std::span<const PoseVector> pattern_;
  int count_ = 0;                                                ///< steps seen
  std::array<std::array<Sum, 2 * kMostSteps + 1>, 2> halves_{};  ///< of the example, by shift
};

}  // namespace etude
