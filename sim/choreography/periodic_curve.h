#pragma once

#include <optional>
#include <vector>

namespace etude {

/// The course of time on the way to a key.
enum class Ease {
  kSmooth,  ///< evenly, flowing through
  kLinger,  ///< most of the way early, then ever slower: hangs before it gets there
  kRush,    ///< slow to start, fast to arrive: a blow, a clap
  kSnap,    ///< waits, covers the way in the second half, and stops dead
  kStep,    ///< waits, goes, waits: what a foot does between leaving the floor and meeting it again
};

/// A smooth closed curve through given values: twice continuously differentiable, also across the
/// ends of the loop, flat at every extreme of the given values (it never overshoots them visibly) and
/// exactly constant between equal neighbours — a foot that is to stand, stands.
///
/// An ease bends the time between two keys, never the way: the curve passes the same values, and joins its neighbours
/// with the same two derivatives. Keys before and after a snap or a step are rests.
///
/// Quintic Hermite segments. Slopes are Fritsch and Butland's weighted harmonic mean (1984);
/// the second derivative at a key is the smaller of what the two neighbouring cubics would have
/// there, or 0 when they disagree in sign (ours).
class PeriodicCurve {
 public:
  struct Key {
    double at;
    double value;
    Ease ease = Ease::kSmooth;  ///< of the way to this key from the one before
    /// Prescribed derivatives, where physics knows them (a flight); found from the neighbours otherwise.
    struct Derivatives {
      double slope, bend;
    };
    std::optional<Derivatives> derivatives{};
  };

  /// `keys` (at least one) lie in [0, period), strictly ascending.
  PeriodicCurve(std::vector<Key> keys, double period);

  /// Returns the value at any time; times outside [0, period) wrap round.
  double At(double time) const;

 private:
  struct Knot {
    double at, value, slope, bend;
    Ease ease;
  };
  std::vector<Knot> knots_;  // closed: the last one is the first, one period later
  double period_;
};

}  // namespace etude
