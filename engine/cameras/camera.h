#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>

namespace [[gnu::visibility("default")]] etude {

/// The distortion of a lens, in OpenCV's models with its coefficients and signs. With r² = x² + y², the model of Brown
/// and Conrady maps the ray through (x, y, 1) in the camera's frame to the ray through (x', y', 1):
///
///     g  = (1 + k1 r² + k2 r⁴ + k3 r⁶) / (1 + k4 r² + k5 r⁴ + k6 r⁶)
///     x' = x g + 2 p1 x y + p2 (r² + 2 x²) + s1 r² + s2 r⁴
///     y' = y g + p1 (r² + 2 y²) + 2 p2 x y + s3 r² + s4 r⁴
///
/// If the sensor is tilted about its axes by tau_x, then tau_y, the ray is shown where it meets the tilted sensor. A
/// fisheye (Kannala and Brandt 2006) instead shows a ray with the angle θ to the axis at a point that has this distance
/// from the centre:
///
///     θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸)
///
/// The intrinsics then map the result to a pixel. With all coefficients zero and no fisheye, the camera is a pinhole.
struct Distortion {
  double k1 = 0, k2 = 0;                  ///< radial coefficients; k1 < 0 is barrel distortion
  double p1 = 0, p2 = 0;                  ///< tangential coefficients: the lens is not parallel to the sensor
  double k3 = 0;                          ///< radial coefficient of r⁶
  double k4 = 0, k5 = 0, k6 = 0;          ///< denominator of the rational model; k4 also belongs to the fisheye
  double s1 = 0, s2 = 0, s3 = 0, s4 = 0;  ///< thin-prism coefficients
  double tau_x = 0, tau_y = 0;            ///< tilt of the sensor, radians
  bool is_fisheye = false;

  bool IsNone() const { return *this == Distortion{}; }
  friend bool operator==(const Distortion&, const Distortion&) = default;
};

/// Returns the distorted point (x', y') of the ray through (x, y, 1).
glm::dvec2 Distort(const Distortion& distortion, const glm::dvec2& ray);

/// Inverts `Distort` by Newton's method to 1e-12. If several rays map to `distorted`, returns the (x, y) nearest to the
/// axis. Returns nullopt if `distorted` is farther from (0, 0) than every (x', y') that the model gives near the axis.
/// For rays beyond that maximum the model *folds back*: |(x', y')| decreases while |(x, y)| grows, which no lens does.
/// For a fisheye, also returns nullopt if the ray does not point to the front of the camera.
std::optional<glm::dvec2> Undistort(const Distortion& distortion, const glm::dvec2& distorted);

/// The intrinsics of a camera in pixels. Image axes: u right, v down, origin at the top left corner; the centre of
/// pixel (i, j) is (i + 0.5, j + 0.5).
struct Intrinsics {
  int width = 640;
  int height = 480;
  double fx = 600;
  double fy = 600;
  double cx = 320;
  double cy = 240;
  double skew = 0;
};

/// A camera in the world W. Its own frame C has x right, y down, z forward (as in OpenCV).
struct Camera {
  Intrinsics intrinsics;
  glm::dmat3 R_CW{1};  ///< rotates world directions into the camera's frame
  glm::dvec3 p_WC{0};  ///< the centre of projection in the world, metres
  Distortion distortion{};
};

struct NamedCamera {
  std::string name;
  Camera camera;
};

/// A point Q, measured in the world (metres), and the pixel that shows it.
struct PointPair {
  glm::dvec3 world{0};  ///< p_WQ
  glm::dvec2 pixel{0};
};

/// Returns the camera at `p_WC` that looks at the point T at `p_WT`, with its v axis as close to downwards as possible.
/// Preconditions: T is not at the camera, and the view is not vertical.
Camera LookAt(const Intrinsics& intrinsics, const glm::dvec3& p_WC, const glm::dvec3& p_WT);

/// Paper B's H (section 2.2), from the world to pixels: (u·w, v·w, w)ᵀ = H (X, Y, Z, 1)ᵀ for a point Q at p_WQ = (X, Y,
/// Z); defined up to scale.
struct ProjectionMatrix {
  std::array<std::array<double, 4>, 3> h{};
};

/// Returns the projection matrix of the camera's pinhole, without its distortion.
ProjectionMatrix MatrixOf(const Camera& camera);

/// Returns the pixel that shows the point Q at `p_WQ`; nullopt if Q lies on or behind the camera's plane. The sign of
/// `matrix` must be such that w > 0 in front of the camera, as in every result of Calibrate (dlt.h).
std::optional<glm::dvec2> Project(const ProjectionMatrix& matrix, const glm::dvec3& p_WQ);

/// Returns the pixel at which the camera with its lens shows Q. Returns nullopt if Q lies on or behind the camera's
/// plane, or so far outside the picture that the distortion model folds back (`Undistort`).
std::optional<glm::dvec2> Project(const Camera& camera, const glm::dvec3& p_WQ);

/// `DistortPixel` maps a pixel of the picture without lens distortion to the pixel of the same ray in the camera's
/// picture; `UndistortPixel` is its inverse. Each returns nullopt for a pixel that has no counterpart.
std::optional<glm::dvec2> DistortPixel(const Camera& camera, const glm::dvec2& pixel);
std::optional<glm::dvec2> UndistortPixel(const Camera& camera, const glm::dvec2& pixel);

}  // namespace etude
