#pragma once

#include <etude/base.h>

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace etude::engine {

/// A camera with its lens. Its own axes are x right, y down, z forward. Pixels: u right, v down; the centre of the
/// first pixel is (0.5, 0.5). Distortion follows Brown and Conrady, with OpenCV's coefficients.
struct Camera {
  std::string name;
  int width = 640, height = 480;
  double fx = 600, fy = 600, cx = 320, cy = 240, skew = 0;
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  glm::dmat3 R_CW{1};
  glm::dvec3 p_WC{0};
};

/// Reads the cameras of a rig from a file of Etude, OpenCV, Pose2Sim, Anipose or Qualisys; the content decides the
/// format. Throws BadInput for anything else.
ETUDE_API std::vector<Camera> ReadRig(std::string_view text, const std::string& file);

/// Returns the pixel at which the camera shows a point; nullopt for a point behind the camera, or outside the field of
/// its lens.
ETUDE_API std::optional<glm::dvec2> Project(const Camera& camera, const glm::dvec3& p_WQ);

/// A point measured in the world, and the pixel that shows it.
struct PointPair {
  glm::dvec3 p_WQ{0};
  glm::dvec2 pixel{0};
};

struct CalibratedCamera {
  Camera camera;
  double rms_px = 0;  ///< root mean square distance between the pairs' pixels and the projections of their points
};

/// Finds the camera with the smallest squared reprojection error. Throws BadInput, with the reason, for pairs that do
/// not determine a camera: fewer than six, points in one plane, or no picture size.
ETUDE_API CalibratedCamera Calibrate(std::span<const PointPair> pairs, int width, int height);

struct TriangulatedPoint {
  glm::dvec3 p_WQ{0};
  double residual_px = 0;  ///< root mean square distance between the sightings and the projected point
};

/// Triangulates a point from its pixels in two or more cameras: one entry per camera, nullopt where a camera does not
/// show it. Returns nullopt for fewer than two sightings, or for rays that are nearly parallel. Throws BadInput if the
/// numbers of pixels and cameras differ.
ETUDE_API std::optional<TriangulatedPoint> Triangulate(std::span<const Camera> cameras,
                                                       std::span<const std::optional<glm::dvec2>> pixels);

}  // namespace etude::engine
