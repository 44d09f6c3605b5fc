#pragma once

#include <span>
#include <vector>

#include "engine/silhouettes/silhouette_body.h"
#include "engine/silhouettes/silhouette_cost.h"

namespace etude {

/// Prior knowledge of a pose: it is near another one, with these standard deviations.
struct PosePrior {
  TreeState near;
  double place_m = 0.1;    ///< of the root's place, along each axis
  double turn_rad = 0.2;   ///< of the root's turn, about each axis
  double angle_rad = 0.2;  ///< of each angle
};

struct FitOptions {
  SilhouetteCostOptions cost;
  int max_iterations = 20;
  /// The smallest share of the cost that a step must lower it by; a step that lowers the cost by less than this share
  /// of it is the last.
  double enough = 1e-3;
};

/// A pose and what it costs.
struct SilhouetteFit {
  TreeState state;
  double picture_cost = 0;  ///< what silhouettes and seen joints say against it
  double cost = 0;          ///< with the habits of the body's angles, and the prior
  int iterations = 0;
};

/// Memory that is kept from fit to fit.
struct FitWorkspace {
  TreeFrames frames;
  std::vector<ProjectedCapsule> flesh;
  std::vector<SilhouetteResidual> residuals;
};

/// Computes what `state` costs. `prior` may be null.
SilhouetteFit CostOf(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& state,
                     const PosePrior* prior, const SilhouetteCostOptions& options, FitWorkspace& workspace);

/// Fits the body to the silhouettes of one moment by Levenberg and Marquardt's method, from `start`: over the root's
/// place and turn and all angles, within their limits (a limit that holds an angle is taken out of the step). The body
/// is analysed by synthesis: no pixel is told which limb it shows; the nearest piece of flesh answers for it.
SilhouetteFit FitSilhouettes(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& start,
                             const PosePrior* prior, const FitOptions& options, FitWorkspace& workspace);

/// The normal equations of a step of `FitSilhouettes`: the gradient of half the cost, and Gauss and Newton's
/// approximation of its Hessian, by columns; first the root's place, then its turn (a rotation vector in the world),
/// then the angles.
struct NormalEquations {
  std::vector<double> gradient;
  std::vector<double> hessian;
};
NormalEquations NormalEquationsAt(const SilhouetteBody& body, std::span<const SilhouetteView> views,
                                  const TreeState& state, const PosePrior* prior, const SilhouetteCostOptions& options,
                                  FitWorkspace& workspace);

}  // namespace etude
