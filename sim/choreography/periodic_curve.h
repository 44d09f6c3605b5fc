#pragma once

#include <vector>

namespace etude {

/// A smooth closed curve through given values: twice continuously differentiable, also across the
/// seam of the loop, flat at every extreme of the given values (it never overshoots them visibly) and
/// exactly constant between equal neighbours — a foot that is to stand, stands.
///
/// Quintic Hermite segments. Slopes are Fritsch and Butland's weighted harmonic mean (1984);
/// the second derivative at a key is the smaller of what the two neighbouring cubics would have
/// there, or 0 when they disagree in sign (ours).
class PeriodicCurve {
 public:
  struct Key {
    double at;
    double value;
  };

  /// `keys` (at least one) lie in [0, period), strictly ascending.
  PeriodicCurve(std::vector<Key> keys, double period);

  /// The value at any time; times outside [0, period) wrap round.
  double At(double time) const;

 private:
  struct Knot {
    double at, value, slope, bend;
  };
  std::vector<Knot> knots_;  // closed: the last one is the first, one period later
  double period_;
};

}  // namespace etude
