#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"

namespace [[gnu::visibility("default")]] etude {

/// A camera and the pixel at which it shows a point.
struct Sighting {
  ProjectionMatrix matrix;
  glm::dvec2 pixel{0};
};

/// The line of sight of a pixel: all points that the pixel may show.
struct SightLine {
  glm::dvec3 camera_W{0};     ///< the camera's centre, metres
  glm::dvec3 direction_W{0};  ///< unit vector away from the camera
};

/// Returns the line of sight; nullopt if the matrix has no centre (a camera at infinity) or a number is not finite.
std::optional<SightLine> SightLineOf(const Sighting& sighting);

/// Returns the point on the line, in front of the camera, that is nearest to the point at `p_WQ`.
glm::dvec3 NearestOn(const SightLine& line, const glm::dvec3& p_WQ);

enum class PointStatus {
  kOk,
  kTooFewViews,     ///< fewer than two sightings
  kIllConditioned,  ///< the lines of sight are (nearly) parallel, or a sighting is not finite
};

struct TriangulatedPoint {
  PointStatus status = PointStatus::kTooFewViews;
  glm::dvec3 position{0};  ///< p_WQ, metres; only when kOk
  double residual_px = 0;  ///< root mean square reprojection distance over the sightings
};

/// Triangulates the point Q seen by two or more cameras (paper B, section 2.4): each sighting gives two linear
/// equations, and p_WQ = V = (MᵀM)⁻¹ Mᵀb. The rows of a camera are divided by |h₃|, where h₃ is the start (three
/// numbers) of the third row of the camera's matrix H, so that the arbitrary scale of H does not change the camera's
/// weight. (The paper prints h₁₄ for h₂₄ in the v rows, a misprint.)
TriangulatedPoint Triangulate(std::span<const Sighting> sightings);

/// Triangulates like `Triangulate`, but also divides every row by the point's depth in its camera *(ours)*, so that
/// distances in pixels are minimised. A distant camera measures the point less accurately and gets less weight. This is
/// iterated linear least squares (Hartley and Sturm 1997, section 4.3) with three iterations. For two cameras at equal
/// distances from the point, the result is the same as by `Triangulate`.
TriangulatedPoint TriangulateByPixels(std::span<const Sighting> sightings);

/// The epipolar constraint of two cameras: bᵀ F a = 0 if a point, at any depth, is at pixel a in the first picture and
/// at pixel b in the second.
class EpipolarGeometry {
 public:
  /// Returns the geometry of two cameras; nullopt if a matrix has no centre (a camera at infinity).
  static std::optional<EpipolarGeometry> Of(const ProjectionMatrix& first, const ProjectionMatrix& second);

  /// Returns the distance in pixels by which two sightings must move to show the same point: the root mean square over
  /// the two pictures, to first order (Sampson's distance; Hartley and Zisserman, section 11.4.3). No point needs to be
  /// triangulated. The sign states on which side of the epipolar lines the pixels lie.
  double DistancePx(const glm::dvec2& first, const glm::dvec2& second) const;

 private:
  glm::dmat3 f_{0};
};

/// The epipolar geometry of every ordered pair of cameras.
class PairGeometry {
 public:
  explicit PairGeometry(std::span<const ProjectionMatrix> cameras);
  /// Returns nullopt if the two indices are equal, or if EpipolarGeometry::Of returns nullopt.
  const std::optional<EpipolarGeometry>& operator()(std::size_t first, std::size_t second) const {
    return of_[first * cameras_ + second];
  }

 private:
  std::size_t cameras_;
  std::vector<std::optional<EpipolarGeometry>> of_;
};

}  // namespace etude
