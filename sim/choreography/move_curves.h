#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "sim/choreography/controls.h"

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

/// One authored pose of a move: the body at a beat.
struct PoseKey {
  double beat = 0;
  Controls controls;
  Ease ease = Ease::kSmooth;  ///< of the way to this pose from the one before
};

/// Returns the keys of one control's curve through the poses of a loop of `beats` beats, each `beat_seconds` long. Two
/// things are not left to the poses, because nobody would author them well enough:
/// - a foot whose spot differs between two poses steps there: it is lifted, travels, and is down again before the pose;
/// - a pose with a jump is the top of a flight that obeys gravity: its height says how far
///   off take-off and landing are, and poses near it do not say how high the body is.
///   Before and after, the hips dip: the knees throw the
///   body up and catch it.
std::vector<PeriodicCurve::Key> KeysOf(const std::vector<PoseKey>& poses, std::size_t control, double beats,
                                       double beat_seconds);

/// Fails, at `place`, unless every jump, the knees' part included, lies within the loop and after the one before.
Result<void> CheckJumps(const std::vector<PoseKey>& poses, double beats, double beat_seconds, const Place& place);

/// A move as smooth curves of its controls over the beats of one performance: what a performer varies
/// before joints are made of it.
class MoveCurves {
 public:
  struct Style {
    /// Follow-through: how many beats the ends of a limb come after its root.
    double overlap_beats = 0;
    /// The depth by which the hips sink on every beat, metres.
    double bounce = 0;
    /// The length of a beat, seconds: gravity decides how many beats a flight lasts.
    double beat_seconds = 0.5;
    /// If true, the last pose leads back to the first; if not, the body stands still in the first pose before it and in
    /// the last one after it.
    bool loops = true;
  };

  MoveCurves() = default;
  /// `keys` (at least one) ascend strictly within [0, beats); the flights of two jumps must not overlap, nor the loop's
  /// seam.
  MoveCurves(const std::vector<PoseKey>& keys, double beats, Style style);

  /// Makes the smooth loop through bodies at even steps of `beats` beats (at least one), for a performance that no
  /// poses describe. Equal neighbours are held exactly.
  static MoveCurves Through(std::span<const Controls> bodies, double beats);

  const Style& style() const { return style_; }

  /// Returns the body at any beat, also before 0 and after the end.
  Controls At(double beat) const;

 private:
  Style style_;
  double last_beat_ = 0;               // of a performance that does not loop
  std::vector<PeriodicCurve> curves_;  // one per control
};

}  // namespace etude
