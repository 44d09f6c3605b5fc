#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/silhouettes/silhouette.h"
#include "engine/silhouettes/silhouette_body.h"

namespace etude {

/// A camera's projection matrix, normalised so that depths are metres, with its scale in pixels. Frames: W the world, Q
/// any point.
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
  /// Returns the focal length in pixels, the geometric mean over both directions: the size of one metre at a depth of
  /// one metre.
  double focal_px() const { return focal_px_; }

  /// The gradients of u, v and of the pixels per metre, with respect to the position of the point.
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

/// One camera's matrix and silhouette in a frame, with the joints that were seen in it.
struct SilhouetteView {
  ProjectionMatrix matrix;  ///< world (metres) to pixels
  const Silhouette* silhouette = nullptr;
  std::span<const SeenJoint> joints = {};
};

/// The options of comparing a pose with silhouettes. All lengths are pixels of the camera.
struct SilhouetteCostOptions {
  /// The residual that counts as one standard deviation, relative to the priors of the body's angles. It is several
  /// times the error of one outline point because the errors of neighbouring points are correlated: clothes, or flesh
  /// of another shape.
  double sigma_px = 8;
  /// The reach of the loss (Geman and McClure): the weight of an outline point, or of flesh outside the silhouette,
  /// falls beyond it. Such a residual comes from a shadow, a lost piece of the mask, or a limb in another position. Use
  /// a wide reach far from the solution and a narrow one near it.
  double outline_reach_px = 14;
  double inside_reach_px = 60;
  /// The share of each flesh radius that must lie inside the silhouette. It is less than 1 because this person may be
  /// thinner than the body.
  double inside_share = 0.8;
  /// The weight of one sample of the flesh relative to one point of the outline.
  double inside_weight = 2;
  /// The reach of the same loss for seen joints, in their standard deviations. A joint beyond it probably belongs to
  /// another person or to the other side of the body.
  double joint_reach = 3;
};

/// One capsule of flesh, projected into one picture: a round cone, all points within a radius of the segment a–b. The
/// radius changes linearly along the segment. Pixels.
struct ProjectedCapsule {
  bool is_valid = false;  ///< false if an end lies behind or too near the camera
  glm::dvec2 a{0}, b{0};
  double radius_a = 0, radius_b = 0;
};

/// A residual and its derivatives by the six numbers of its capsule: it is e + Σ slopesᵢ δᵢ with δ = changes of (a.u,
/// a.v, radius_a, b.u, b.v, radius_b).
struct SilhouetteResidual {
  double value = 0;  ///< e, pixels
  int capsule = -1;  ///< -1: none
  std::array<double, 6> slopes{};
  bool is_inside = false;  ///< true: a sample of the flesh (containment); false: a point of the outline (coverage)
};

/// Projects the flesh of the body in the pose of `frames` into one picture.
void ProjectFlesh(const SilhouetteBody& body, const TreeFrames& frames, const ProjectionMatrix& matrix,
                  std::vector<ProjectedCapsule>& out);

/// Returns the signed distance from `pixel` to the outline of a projected capsule, negative inside, with its
/// derivatives.
SilhouetteResidual DistanceTo(const ProjectedCapsule& capsule, const glm::dvec2& pixel);

/// Returns that distance alone.
double SignedDistanceTo(const ProjectedCapsule& capsule, const glm::dvec2& pixel);

/// The flesh of one pose in one picture, with the nearest capsule of every point of the outline. It depends on no option
/// of the cost, so a fit computes it once for each pose.
struct SeenFlesh {
  std::vector<ProjectedCapsule> capsules;
  std::vector<double> distances;  ///< by column of the silhouette: the smallest signed distance to a capsule, pixels
  std::vector<double> owners;     ///< by column: that capsule's index; -1 if none is valid
  /// By capsule: the silhouette's signed distances at kInsideSamples points along its axis, pixels.
  static constexpr std::size_t kInsideSamples = 4;
  std::vector<std::array<DistanceAt, kInsideSamples>> inside;
};
/// Finds all distances of `flesh.capsules`.
void MeasureFlesh(const Silhouette& silhouette, SeenFlesh& flesh);

/// Appends the residuals of the flesh in one picture to `out`:
/// - coverage: every point of the silhouette's outline lies on the outline of the flesh, so its signed distance to the
///   nearest capsule is 0;
/// - containment: every capsule lies inside the silhouette: at samples along its axis, the silhouette's signed distance
///   plus `inside_share` of the radius is at most 0. Samples that satisfy this leave no residual.
void AppendResiduals(const SeenFlesh& flesh, const Silhouette& silhouette, const SilhouetteCostOptions& options,
                     std::vector<SilhouetteResidual>& out);

/// Adds the losses (LossOf) of the same residuals to `sum`, one after the other.
void AddLosses(const SeenFlesh& flesh, const Silhouette& silhouette, const SilhouetteCostOptions& options, double& sum);

/// AddLosses in two steps, for a search that tries many positions of a few capsules. OutlineDistances lowers each of
/// `distances` (pixels, one per column of the silhouette) to the point's smallest signed distance to `flesh`, if that
/// is less.
void AddContainmentLosses(const std::vector<ProjectedCapsule>& flesh, const Silhouette& silhouette,
                          const SilhouetteCostOptions& options, double& sum);
void OutlineDistances(const std::vector<ProjectedCapsule>& flesh, const Silhouette& silhouette,
                      std::span<double> distances);

/// Geman and McClure's loss of a residual, e²/(1 + e²/reach²) in units of sigma², and the weight of its square in a
/// Gauss–Newton step.
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
