#pragma once

#include <glm/glm.hpp>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"

namespace etude {

/// Paper B's six intrinsic and six extrinsic parameters of a camera (section 2.2), in the usual form of the pinhole:
///
///             [ f/δu   −(f/δu)·cot θ   pu ]
///         H ~ [  0      f/(δv·sin θ)   pv ] · [ R_CW | t ],    R_CW = Rx(ω) Ry(φ) Rz(κ).
///             [  0           0          1 ]
///
/// These are twelve parameters for eleven degrees of freedom, so *(ours)* δv := 1: f is in pixel heights.
struct CameraParameters {
  double focal_length = 600;  ///< f, pixel heights; > 0
  double delta_u = 1;         ///< width of a pixel, in pixel heights; > 0
  double delta_v = 1;         ///< height of a pixel; always 1, because pixel heights are the unit
  double principal_u = 320;   ///< pu, pixels
  double principal_v = 240;   ///< pv, pixels
  double skew = kRightAngle;  ///< θ, angle between the axes of the picture, radians, in (0, π)
  double omega = 0;           ///< rotations about x, y and z, radians; φ in [−π/2, π/2]
  double phi = 0;
  double kappa = 0;
  glm::dvec3 t{0};  ///< p_CW: from the camera's centre to the world's origin, in the camera's frame, metres

  static constexpr double kRightAngle = 1.5707963267948966;
};

/// Decomposes a projection matrix into its parameters, in closed form. Fails if it is not a camera's matrix: an element
/// is not finite, rows are parallel, or the picture is mirrored.
Result<CameraParameters> Decompose(const ProjectionMatrix& matrix);

/// `ToCamera` makes the pinhole camera with these parameters and a picture of `width` × `height` pixels; `ParametersIn`
/// returns the parameters of a camera without its distortion.
Camera ToCamera(const CameraParameters& parameters, int width, int height);
CameraParameters ParametersIn(const Camera& camera);

}  // namespace etude
