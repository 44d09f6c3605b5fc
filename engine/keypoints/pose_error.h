#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/point_error.h"
#include "engine/motion/body.h"

namespace etude {

/// The expected errors of one joint, as mean squares, so that errors of several poses can be averaged. The limb of a
/// joint is the limb that ends in the joint; the hip centre has no limb.
struct JointErrors {
  double point = 0;       ///< error of the triangulated position, m²
  double body = 0;        ///< error of the position in the fitted body, m²
  double point_turn = 0;  ///< error of the limb's direction between the triangulated positions, rad²
  double body_turn = 0;   ///< error of the limb's direction in the fitted body, rad²
};

/// Returns false for hip centre, shoulder centre and spine, which lie between triangulated joints.
bool IsTriangulated(Role role);

/// Computes, to first order, the expected errors of the joints of one pose that `TriangulatePerson` and `FitPerson`
/// recover. Seventeen joints are triangulated; hip centre, shoulder centre and spine lie between them. The fitted body
/// is the projection of all joint positions onto the positions that the body's angles and root can reach: J(JᵀJ)⁺Jᵀ
/// with the derivatives J of the joints. The body's bone lengths are medians of many frames and count as exact.
/// *(Ours.)*
class PoseErrorForecast {
 public:
  /// Fails if no body can have this pose, because two joints coincide.
  static Result<PoseErrorForecast> Of(const BodyPose& pose);

  /// Returns the errors of all joints if the pose is moved by `shift`, metres; nullopt if some joint cannot be
  /// triangulated there. The preconditions are those of ExpectedPointError.
  /// @param noise_px the deviation of each role's keypoints; if empty, `errors.noise_px` applies to all roles
  std::optional<std::array<JointErrors, kRoleCount>> At(std::span<const Camera> cameras, const glm::dvec3& shift,
                                                        SightingErrors errors,
                                                        std::span<const double> noise_px = {}) const;

 private:
  BodyPose pose_;
  /// Matrices of 60 × 60, column by column, in metres per metre. They map the errors of the triangulated joints to the
  /// errors of all joints (`to_points_`) and of the fitted body's joints (`to_body_`).
  std::vector<double> to_points_, to_body_;
};

}  // namespace etude
