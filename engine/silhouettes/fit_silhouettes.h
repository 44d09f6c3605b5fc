#pragma once

#include <limits>
#include <span>
#include <vector>

#include "engine/silhouettes/silhouette_body.h"
#include "engine/silhouettes/silhouette_cost.h"

namespace etude {

/// A normal prior of the body's pose: the mean pose `near`, and standard deviations.
struct PosePrior {
  TreeState near;
  double place_m = 0.1;    ///< standard deviation of the root's position along each axis, metres
  double turn_rad = 0.2;   ///< standard deviation of the root's rotation about each axis
  double angle_rad = 0.2;  ///< standard deviation of each angle
};

struct FitOptions {
  SilhouetteCostOptions cost;
  int max_iterations = 20;
  /// The iteration ends after a step that lowers the cost by less than this share of the cost.
  double enough = 1e-3;
};

/// A pose and its cost.
struct SilhouetteFit {
  TreeState state;
  double picture_cost = 0;  ///< cost of the silhouettes and seen joints
  double cost = 0;          ///< `picture_cost` plus the cost of the angle priors and of the pose prior
  int iterations = 0;
};

/// Memory that later fits use again.
struct FitWorkspace {
  TreeFrames frames;
  std::vector<SeenFlesh> flesh;  ///< per view: the capsules in the pose whose cost was computed last
  std::vector<SeenFlesh> kept;   ///< per view: the capsules in the pose at which the last fit ended
  std::vector<SilhouetteResidual> residuals;
  ResidualSums sums;
};

/// Computes the cost of `state`. `prior` may be null. As soon as the cost is certain to reach `limit`, returns an
/// infinite cost; this is safe because the cost is a sum of losses ≥ 0.
SilhouetteFit CostOf(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& state,
                     const PosePrior* prior, const SilhouetteCostOptions& options, FitWorkspace& workspace,
                     double limit = std::numeric_limits<double>::infinity());

/// Fits the body to the silhouettes of one moment (the pictures of one time) by the method of Levenberg and Marquardt,
/// from `start`, over the root's position, the root's rotation and all angles within their limits. Angles that are held
/// at a limit are left out of the step. This is analysis by synthesis: no pixel is labelled with a limb; each outline
/// point is attributed to the nearest capsule.
SilhouetteFit FitSilhouettes(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& start,
                             const PosePrior* prior, const FitOptions& options, FitWorkspace& workspace);
/// Continues a fit with other options. `start` must be the pose at which the last fit with this `workspace` ended, for
/// the same body and views.
SilhouetteFit FitFurther(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& start,
                         const PosePrior* prior, const FitOptions& options, FitWorkspace& workspace);

/// The normal equations of a step of `FitSilhouettes`: the gradient of half the cost, and its Hessian in the
/// Gauss–Newton approximation, stored by columns. The coordinates are the root's position, the root's rotation (a
/// rotation vector in the world), then the angles.
struct NormalEquations {
  std::vector<double> gradient;
  std::vector<double> hessian;
};
NormalEquations NormalEquationsAt(const SilhouetteBody& body, std::span<const SilhouetteView> views,
                                  const TreeState& state, const PosePrior* prior, const SilhouetteCostOptions& options,
                                  FitWorkspace& workspace);

}  // namespace etude
