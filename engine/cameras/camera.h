#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "engine/cameras/distortion.h"

namespace etude {

/// The intrinsics of a camera, pixels. Image axes: u right, v down, origin at the top left corner;
/// the centre of pixel (i, j) is (i + 0.5, j + 0.5).
struct Intrinsics {
  int width = 640;
  int height = 480;
  double fx = 600;
  double fy = 600;
  double cx = 320;
  double cy = 240;
  double skew = 0;
};

/// A camera in the world W. Its own frame C: x right, y down, z forward (as OpenCV).
struct Camera {
  Intrinsics intrinsics;
  glm::dmat3 R_CW{1};  ///< rotates world directions into the camera's frame
  glm::dvec3 p_WC{0};  ///< the centre of projection in the world, metres
  Distortion distortion{};
};

/// The camera at `p_WC` looking at the point T at `p_WT`, its v axis pointing down as far as possible.
/// T is not at the camera, and the view is not vertical.
Camera LookAt(const Intrinsics& intrinsics, const glm::dvec3& p_WC, const glm::dvec3& p_WT);

/// Paper B's H (section 2.2), from the world to pixels: (u·w, v·w, w)ᵀ = H (X, Y, Z, 1)ᵀ with p_WQ = (X, Y, Z) of a
/// point Q; defined up to scale.
struct ProjectionMatrix {
  std::array<std::array<double, 4>, 3> h{};
};

/// Of the camera's pinhole: a matrix knows no distortion.
ProjectionMatrix MatrixOf(const Camera& camera);

/// The pixel that shows the point Q at `p_WQ`; nothing when it lies on or behind the camera's plane. The sign of H is
/// taken such that w > 0 in front of the camera (DLT normalises it so).
std::optional<glm::dvec2> Project(const ProjectionMatrix& matrix, const glm::dvec3& p_WQ);

/// The same of a camera with its lens. Nothing, too, far outside the picture where a lens of that distortion would fold
/// the world back into it.
std::optional<glm::dvec2> Project(const Camera& camera, const glm::dvec3& p_WQ);

/// The pixel that shows what a pinhole would show at `pixel`, and the other way round: nothing where there is none.
std::optional<glm::dvec2> DistortPixel(const Camera& camera, const glm::dvec2& pixel);
std::optional<glm::dvec2> UndistortPixel(const Camera& camera, const glm::dvec2& pixel);

}  // namespace etude
