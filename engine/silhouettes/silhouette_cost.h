#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/silhouettes/nearest_cones.h"
#include "engine/silhouettes/silhouette.h"
#include "engine/silhouettes/silhouette_body.h"

namespace etude {

/// A camera's projection matrix, normalised so that depths are in metres, with the camera's focal length in pixels.
/// p_WQ is the position of a point Q in the world's frame W, metres.
class PixelScale {
 public:
  explicit PixelScale(const ProjectionMatrix& matrix) {
    const auto row = [&](int i) { return glm::dvec3(matrix.h[i][0], matrix.h[i][1], matrix.h[i][2]); };
    const double length = glm::length(row(2));
    for (int i = 0; i < 3; ++i) {
      rows_[i] = row(i) / length;
      offsets_[i] = matrix.h[i][3] / length;
    }
    focal_px_ = std::sqrt(glm::length(glm::cross(rows_[0], rows_[2])) * glm::length(glm::cross(rows_[1], rows_[2])));
  }

  /// Returns the depth along the camera's axis, metres; positive in front of it.
  double DepthOf(const glm::dvec3& p_WQ) const { return glm::dot(rows_[2], p_WQ) + offsets_[2]; }
  glm::dvec2 PixelOf(const glm::dvec3& p_WQ) const {
    return glm::dvec2(glm::dot(rows_[0], p_WQ) + offsets_[0], glm::dot(rows_[1], p_WQ) + offsets_[1]) / DepthOf(p_WQ);
  }
  /// Returns the size in pixels of one metre at a depth of one metre: the focal length, as the geometric mean of the
  /// focal lengths along u and v.
  double focal_px() const { return focal_px_; }

  /// The gradients, with respect to the point's position, of u, of v, and of the scale at the point (pixels per metre).
  struct Slopes {
    glm::dvec3 u, v, pixels_per_metre;
  };
  Slopes SlopesAt(const glm::dvec3& p_WQ) const {
    const double depth = DepthOf(p_WQ);
    const glm::dvec2 pixel = PixelOf(p_WQ);
    return {(rows_[0] - pixel.x * rows_[2]) / depth, (rows_[1] - pixel.y * rows_[2]) / depth,
            -focal_px_ / (depth * depth) * rows_[2]};
  }

 private:
  std::array<glm::dvec3, 3> rows_{};
  std::array<double, 3> offsets_{};
  double focal_px_ = 0;
};

/// The pixel at which a keypoint estimator or an annotator sees a joint.
struct SeenJoint {
  Role role = Role::kHipCentre;
  glm::dvec2 pixel{0};
  double sigma_px = 4;  ///< standard deviation along u and v
};

/// One camera's matrix and silhouette in a frame, with the joints that were seen in this picture.
struct SilhouetteView {
  ProjectionMatrix matrix;  ///< world (metres) to pixels
  const Silhouette* silhouette = nullptr;
  std::span<const SeenJoint> joints = {};
};

/// Options for comparing a pose with silhouettes. All lengths are in pixels of the camera.
struct SilhouetteCostOptions {
  /// The residual that weighs as much as one standard deviation in the priors of the body's angles. It is several times
  /// the error of one outline point, because clothes and differences in body shape make the errors of neighbouring
  /// points correlated.
  double sigma_px = 8;
  /// The reach of the loss (Geman and McClure). A larger residual, of an outline point or of flesh outside the
  /// silhouette, gets less weight: it comes from a shadow, a lost piece of the mask, or a limb in another position. Use
  /// a wide reach far from the solution, and a narrow reach near it.
  double outline_reach_px = 14;
  double inside_reach_px = 60;
  /// The share of each flesh radius that must lie inside the silhouette. It is below 1 because the person may be
  /// thinner than the body model.
  double inside_share = 0.8;
  /// The weight of one flesh sample (containment) relative to one outline point (coverage).
  double inside_weight = 2;
  /// The reach of the loss for seen joints, in standard deviations of a joint. A joint with a larger residual probably
  /// belongs to another person or to the other side of the body.
  double joint_reach = 3;
};

/// One capsule of flesh, projected into one picture: a round cone, all points within a radius of the segment a–b. The
/// radius changes linearly along the segment. Pixels.
struct ProjectedCapsule {
  bool is_valid = false;  ///< false if an end lies behind or too near the camera
  glm::dvec2 a{0}, b{0};
  double radius_a = 0, radius_b = 0;
};

/// A residual and its derivatives with respect to the six numbers of its capsule. Near the current pose the residual is
/// e + Σ slopesᵢ δᵢ, where δ are changes of (a.u, a.v, radius_a, b.u, b.v, radius_b).
struct SilhouetteResidual {
  double value = 0;  ///< e, pixels
  int capsule = -1;  ///< index of the capsule; -1 if there is none
  std::array<double, 6> slopes{};
  bool is_inside = false;  ///< true: a sample of the flesh (containment); false: a point of the outline (coverage)
};

/// Projects the body's flesh capsules, placed by `frames`, into one picture.
void ProjectFlesh(const SilhouetteBody& body, const TreeFrames& frames, const ProjectionMatrix& matrix,
                  std::vector<ProjectedCapsule>& out);

/// Returns the signed distance from `pixel` to the outline of a projected capsule, negative inside, with its
/// derivatives.
SilhouetteResidual DistanceTo(const ProjectedCapsule& capsule, const glm::dvec2& pixel);

/// Returns only the signed distance of DistanceTo.
double SignedDistanceTo(const ProjectedCapsule& capsule, const glm::dvec2& pixel);

/// The capsules of a body in one pose, projected into one picture, and the capsule nearest to every outline point. No
/// option of the cost changes these values, so a fit computes them once for each pose.
struct SeenFlesh {
  std::vector<ProjectedCapsule> capsules;
  std::vector<double> distances;  ///< by column of the silhouette: the smallest signed distance to a capsule, pixels
  std::vector<double> owners;     ///< by column: the nearest capsule's index; -1 if no capsule is valid
  ConeColumns cones;              ///< the capsules, prepared for FindNearestCones
  /// For each capsule, the silhouette's signed distances at kInsideSamples points along the capsule's axis, pixels.
  static constexpr std::size_t kInsideSamples = 4;
  std::vector<std::array<DistanceAt, kInsideSamples>> inside;
};
/// Computes the other members of `flesh` for the capsules `flesh.capsules`.
void MeasureFlesh(const Silhouette& silhouette, SeenFlesh& flesh);

/// Appends the residuals of the flesh in one picture to `out`:
/// - coverage: every point of the silhouette's outline should lie on the outline of the capsules. The residual is the
///   point's signed distance to the nearest capsule;
/// - containment: every capsule should lie inside the silhouette. The residual of a sample on the capsule's axis is the
///   silhouette's signed distance there plus `inside_share` of the radius; there is none if this sum is at most 0.
void AppendResiduals(const SeenFlesh& flesh, const Silhouette& silhouette, const SilhouetteCostOptions& options,
                     std::vector<SilhouetteResidual>& out);

/// The normal equations of the residuals of AppendResiduals, with respect to the six numbers of each capsule.
struct ResidualSums {
  std::vector<ConeSums> capsules;
  std::vector<double> u, v;  ///< the outline points, sorted by capsule
};
void SumResiduals(const SeenFlesh& flesh, const Silhouette& silhouette, const SilhouetteCostOptions& options,
                  ResidualSums& out);

/// Adds the loss (LossOf) of every residual of AppendResiduals to `sum`, in order.
void AddLosses(const SeenFlesh& flesh, const Silhouette& silhouette, const SilhouetteCostOptions& options, double& sum);

/// These functions do the work of AddLosses in steps, for a search that tries many positions of a few capsules.
/// OutlineDistances computes each outline point's smallest signed distance to `flesh`, pixels. `distances` has one
/// entry per column of the silhouette; an entry is replaced if the point's computed distance is smaller.
void AddContainmentLosses(const std::vector<ProjectedCapsule>& flesh, const Silhouette& silhouette,
                          const SilhouetteCostOptions& options, double& sum);
void OutlineDistances(const std::vector<ProjectedCapsule>& flesh, const Silhouette& silhouette,
                      std::span<double> distances);

/// Geman and McClure's loss for a residual e: `loss` is e²/(1 + e²/reach²) in units of sigma², `weight` is the weight
/// of e² in a Gauss–Newton step.
struct Loss {
  double loss = 0;
  double weight = 0;
};
inline Loss LossOf(const SilhouetteResidual& residual, const SilhouetteCostOptions& options) {
  const double reach = residual.is_inside ? options.inside_reach_px : options.outline_reach_px;
  const double counts = (residual.is_inside ? options.inside_weight : 1) / (options.sigma_px * options.sigma_px);
  const double square = residual.value * residual.value;
  const double share = 1 / (1 + square / (reach * reach));
  return {counts * square * share, counts * share * share};
}

}  // namespace etude
