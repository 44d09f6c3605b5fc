#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "sim/choreography/controls.h"

namespace etude {

/// The timing of the motion from one key to the next.
enum class Ease {
  kSmooth,  ///< evenly, passing through the key
  kLinger,  ///< fast at first, then ever slower: hovers before it arrives
  kRush,    ///< starts slowly and arrives fast: a blow, a clap
  kSnap,    ///< waits, covers the way in the second half of the time, and stops abruptly
  kStep,    ///< waits, moves, waits: a foot between leaving the floor and landing
};

/// A smooth closed curve through given values. It is twice continuously differentiable, also across the ends of the
/// loop. It is flat at every extreme of the given values, without visible overshoot. Between equal neighbours it is
/// exactly constant, so a standing foot does not move.
///
/// An ease changes the timing between two keys but not the path: the curve passes through the same values and keeps
/// both derivatives at the keys. Keys before and after a snap or a step are at rest.
///
/// The segments are quintic Hermite polynomials. Slopes are the weighted harmonic means of Fritsch and Butland (1984).
/// The two cubic Hermite segments that meet at a key have two second derivatives there: the one with the smaller
/// magnitude is taken, or 0 if their signs differ (ours).
class PeriodicCurve {
 public:
  struct Key {
    double at;
    double value;
    Ease ease = Ease::kSmooth;  ///< timing of the motion from the previous key to this key
    /// The first and second derivatives (`slope`, `bend`) at this key, if physics determines them (in a flight).
    /// Otherwise they are computed from the neighbouring keys.
    struct Derivatives {
      double slope, bend;
    };
    std::optional<Derivatives> derivatives{};
  };

  /// `keys` (at least one) lie in [0, period) and ascend strictly.
  PeriodicCurve(std::vector<Key> keys, double period);

  /// Returns the value at any time; times outside [0, period) wrap around.
  double At(double time) const;

 private:
  struct Knot {
    double at, value, slope, bend;
    Ease ease;
  };
  std::vector<Knot> knots_;  // knots of the closed curve: the last knot is the first knot, one period later
  double period_;
};

/// One authored pose of a move: the body at a beat.
struct PoseKey {
  double beat = 0;
  Controls controls;
  Ease ease = Ease::kSmooth;  ///< timing of the motion from the previous pose to this pose
};

/// Returns the keys of one control's curve through the poses of a loop of `beats` beats, each `beat_seconds` long. Two
/// things are computed, because authored values would not be accurate enough:
/// - If the spot of a foot differs between two poses, the foot makes a step: it is lifted, moves, and is down again
///   before the second pose.
/// - A pose with a jump is the top of a flight under gravity. The jump's height determines when the body takes off and
///   lands; poses within the jump do not affect the height of the body. Before take-off and after landing the hips dip,
///   because the knees push off and absorb the landing.
std::vector<PeriodicCurve::Key> KeysOf(const std::vector<PoseKey>& poses, std::size_t control, double beats,
                                       double beat_seconds);

/// Fails at `place` if a jump, including push-off and landing, does not lie within the loop or overlaps the previous
/// jump.
Result<void> CheckJumps(const std::vector<PoseKey>& poses, double beats, double beat_seconds, const Place& place);

/// The smooth curves of a move's controls over the beats of one performance. Performers vary these curves before joints
/// are computed.
class MoveCurves {
 public:
  struct Style {
    /// Follow-through: the end of a limb moves this many beats later than the root of the limb.
    double overlap_beats = 0;
    /// The depth by which the hips sink on every beat, metres.
    double bounce = 0;
    /// The length of a beat in seconds; it determines how many beats a flight lasts.
    double beat_seconds = 0.5;
    /// If true, the last pose leads back to the first pose. If false, the body rests in the first pose before the move,
    /// and in the last pose after it.
    bool loops = true;
  };

  MoveCurves() = default;
  /// `keys` (at least one) ascend strictly within [0, beats). The flights of two jumps must not overlap, and no flight
  /// may cross the end of the loop.
  MoveCurves(const std::vector<PoseKey>& keys, double beats, Style style);

  /// Makes the smooth loop through `bodies` (at least one), which are equally spaced over `beats` beats, for a
  /// performance without authored poses. The curves are exactly constant between equal neighbours.
  static MoveCurves Through(std::span<const Controls> bodies, double beats);

  const Style& style() const { return style_; }

  /// Returns the body at any beat, including beats before 0 and after the end.
  Controls At(double beat) const;

 private:
  Style style_;
  double last_beat_ = 0;               // beat of the last pose; used if the performance does not loop
  std::vector<PeriodicCurve> curves_;  // one curve per control
};

}  // namespace etude
