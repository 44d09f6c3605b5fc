#pragma once

#include <vector>

#include "sim/choreography/controls.h"
#include "sim/choreography/periodic_curve.h"

namespace etude {

/// One authored pose of a move: the body at a beat.
struct PoseKey {
  double beat = 0;
  Controls controls;
};

/// A move as smooth curves of its controls over the beats of one loop: what a performer varies before
/// joints are made of it.
class MoveCurves {
 public:
  struct Style {
    /// Follow-through: how many beats the ends of a limb come after its root.
    double overlap_beats = 0;
    /// How far the hips sink on every beat, metres.
    double bounce = 0;
  };

  MoveCurves() = default;
  /// `keys` (at least one) ascend strictly within [0, beats).
  MoveCurves(const std::vector<PoseKey>& keys, double beats, Style style);

  /// The body at any beat; the loop goes on before 0 and after its end.
  Controls At(double beat) const;

 private:
  Style style_;
  std::vector<PeriodicCurve> curves_;  // one per control
};

}  // namespace etude
