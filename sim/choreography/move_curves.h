#pragma once

#include <span>
#include <vector>

#include "sim/choreography/control_keys.h"
#include "sim/choreography/controls.h"
#include "sim/choreography/periodic_curve.h"

namespace etude {

/// A move as smooth curves of its controls over the beats of one performance: what a performer varies
/// before joints are made of it.
class MoveCurves {
 public:
  struct Style {
    /// Follow-through: how many beats the ends of a limb come after its root.
    double overlap_beats = 0;
    /// How far the hips sink on every beat, metres.
    double bounce = 0;
    /// At the move's own tempo: gravity decides how many beats a flight lasts.
    double beat_seconds = 0.5;
    /// Whether the last pose leads back to the first; if not, the body stands still in the first pose
    /// before it and in the last one after it.
    bool loops = true;
  };

  MoveCurves() = default;
  /// `keys` (at least one) ascend strictly within [0, beats); the flights of two jumps must not overlap, nor the loop's
  /// seam.
  MoveCurves(const std::vector<PoseKey>& keys, double beats, Style style);

  /// The smooth loop through bodies at even steps of `beats` beats (at least one): for a performance that no poses
  /// describe. Equal neighbours are held exactly.
  static MoveCurves Through(std::span<const Controls> bodies, double beats);

  const Style& style() const { return style_; }

  /// The body at any beat, before 0 and after the end too.
  Controls At(double beat) const;

 private:
  Style style_;
  double last_beat_ = 0;               // of a performance that does not loop
  std::vector<PeriodicCurve> curves_;  // one per control
};

}  // namespace etude
