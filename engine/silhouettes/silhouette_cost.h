#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/silhouettes/silhouette.h"
#include "engine/silhouettes/silhouette_body.h"

namespace etude {

/// One camera's share of a frame.
struct SilhouetteView {
  ProjectionMatrix matrix;  ///< world (metres) to pixels
  const Silhouette* silhouette = nullptr;
};

/// How a pose of the body is compared with silhouettes. All lengths in pixels of the camera.
struct SilhouetteCostOptions {
  /// A residual of this size counts as one standard deviation, against the habits of the body's angles. It is several
  /// times what an outline errs, because neighbouring points err alike: clothes, flesh of other shape.
  double sigma_px = 8;
  /// Beyond this distance an outline point, or a piece of the body outside the silhouette, counts less and less (Geman
  /// and McClure's loss): what it tells is somebody's shadow, a lost piece, or a limb that is elsewhere. Wide far from
  /// the solution, narrow near it.
  double outline_reach_px = 14;
  double inside_reach_px = 60;
  /// How much of the flesh must lie inside: 1 all of it. Less, because this person may be thinner.
  double inside_share = 0.8;
  /// What one sample of the flesh counts, beside one point of the outline.
  double inside_weight = 2;
};

/// The flesh of one pose in one picture: each piece's outline is that of a round cone, all points within a radius of a
/// segment, where the radius changes evenly along it.
struct ProjectedCapsule {
  bool is_valid = false;  ///< false: a part of it is behind the camera
  glm::dvec2 a{0}, b{0};
  double radius_a = 0, radius_b = 0;
};

/// A residual and how it moves with the six numbers of its capsule: e + Σ cᵢ δᵢ, δ = (a.u, a.v, radius_a, b.u, b.v,
/// radius_b).
struct SilhouetteResidual {
  double value = 0;  ///< pixels
  int capsule = -1;  ///< -1: none
  std::array<double, 6> slopes{};
  bool is_inside = false;  ///< of a sample of the flesh; else of a point of the outline
};

/// The flesh in the pose of `frames`.
void ProjectFlesh(const SilhouetteBody& body, const TreeFrames& frames, const ProjectionMatrix& matrix,
                  std::vector<ProjectedCapsule>& out);

/// The signed distance from `pixel` to the outline of a projected capsule, negative inside, with its slopes.
SilhouetteResidual DistanceTo(const ProjectedCapsule& capsule, const glm::dvec2& pixel);

/// What one picture says about the flesh, appended to `out`:
/// - coverage: every point of the silhouette's outline lies on the outline of the flesh: its signed distance to the
///   nearest piece is 0;
/// - containment: every piece of flesh lies inside the silhouette: at samples along its axis, the silhouette's signed
///   distance plus `inside_share` of the radius is not positive. Samples for which that holds leave no residual.
void AppendResiduals(const std::vector<ProjectedCapsule>& flesh, const Silhouette& silhouette,
                     const SilhouetteCostOptions& options, std::vector<SilhouetteResidual>& out);

/// The two halves of AppendResiduals, for a search that tries many places of a few pieces. Containment alone, of these
/// pieces; and of each outline point the least signed distance: `distances` fall to those of `flesh` where these are
/// less.
void AppendContainment(const std::vector<ProjectedCapsule>& flesh, const Silhouette& silhouette,
                       const SilhouetteCostOptions& options, std::vector<SilhouetteResidual>& out);
void OutlineDistances(const std::vector<ProjectedCapsule>& flesh, const Silhouette& silhouette,
                      std::span<double> distances);

/// The loss of a residual and the weight of its square in a step: Geman and McClure's e²/(1 + e²/reach²), in units of
/// sigma².
struct Loss {
  double loss = 0;
  double weight = 0;
};
Loss LossOf(const SilhouetteResidual& residual, const SilhouetteCostOptions& options);

}  // namespace etude
