#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/body_tree.h"
#include "engine/silhouettes/fit_silhouettes.h"

namespace etude {

/// The limbs of an adult of that stature, metres: those of `LimbLengths{}`, whose stature is 1.74, all scaled alike.
LimbLengths AdultLengths(double stature_m);

/// One moment of a take: what its pictures show, and the pose that was found in them.
struct PosedViews {
  std::span<const SilhouetteView> views;
  TreeState state;
};

/// Which stature costs least (ours): of adults who stand as these moments say, 6 % smaller to 6 % larger than
/// `stature_m`, each fitted anew from there, as thick as `body` is beside an average adult of `stature_m`. A silhouette
/// tells it because cameras tell metres. `body` is `MakeSilhouetteBody(AdultLengths(stature_m))` with any thickness.
double FitStature(const SilhouetteBody& body, double stature_m, std::span<const PosedViews> moments,
                  const FitOptions& options);

}  // namespace etude
