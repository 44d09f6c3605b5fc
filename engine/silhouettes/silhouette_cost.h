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

/// A camera's matrix, normalised so that depths are metres, with the scale of what it shows. Frames: W the world, Q any
/// point.
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
  /// Returns the size in pixels of one metre, one metre away: the geometric mean of both directions.
  double focal_px() const { return focal_px_; }

  /// The gradients of u, v and of the pixels per metre, with respect to the place of the point.
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

/// A joint of the body where a picture shows it, as an estimator of keypoints or somebody who marks says.
struct SeenJoint {
  Role role = Role::kHipCentre;
  glm::dvec2 pixel{0};
  double sigma_px = 4;  ///< standard deviation along u and v; the surer, the less
};

/// One camera's matrix and silhouette in a frame, and the joints that are told beside it.
struct SilhouetteView {
  ProjectionMatrix matrix;  ///< world (metres) to pixels
  const Silhouette* silhouette = nullptr;
  std::span<const SeenJoint> joints = {};
};

/// The options of comparing a pose with silhouettes. All lengths are pixels of the camera.
struct SilhouetteCostOptions {
  /// The size of a residual that counts as one standard deviation, against the habits of the body's angles. It is
  /// several times what an outline errs, because neighbouring points err alike: clothes, flesh of other shape.
  double sigma_px = 8;
  /// The distance beyond which an outline point, or a piece of the body outside the silhouette, counts less and less
  /// (Geman and McClure's loss): it shows somebody's shadow, a lost piece, or a limb that is elsewhere. Wide far from
  /// the solution, narrow near it.
  double outline_reach_px = 14;
  double inside_reach_px = 60;
  /// The share of the flesh that must lie inside; less than 1 because this person may be thinner.
  double inside_share = 0.8;
  /// The weight of one sample of the flesh relative to one point of the outline.
  double inside_weight = 2;
  /// The standard deviations beyond which a seen joint counts less and less, by the same loss: it is another's, or the
  /// other side's.
  double joint_reach = 3;
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

/// Appends the residuals of the flesh in one picture to `out`:
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
