#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/cameras/refine.h"

namespace etude {

/// Computes the homography from a plane to its picture: (u·w, v·w, w)ᵀ = H (x, y, 1)ᵀ of points (x, y, 0), by the
/// normalised direct linear transform. Of any scale. Fails for fewer than four points, points that lie on one line
/// (nearly), or that are not finite.
Result<glm::dmat3> HomographyOf(std::span<const PointPair> pairs);

/// Estimates the focal lengths of a camera from homographies of planes, without skew and distortion and with the
/// principal point in the middle of its picture (Zhang 2000, section 3.1, with the principal point given): a start for
/// `RefineRig`. Fails when all planes face the camera straight on, which says nothing about its focal length.
Result<Intrinsics> IntrinsicsFromPlanes(std::span<const glm::dmat3> homographies, int width, int height);

/// Returns the pose of the plane in the camera's frame (R_CT, p_CT), in front of the camera.
TargetPlace PoseOfPlane(const Intrinsics& intrinsics, const glm::dmat3& homography);

struct PictureSize {
  int width = 0;
  int height = 0;
};

/// Calibrates cameras from flat boards in their pictures: each camera's intrinsics from its homographies, the cameras
/// joined through boards that two of them see at once, then all together by `RefineRig`. A target is a board at one
/// place; the first one that `views` names defines the world: it stands still at its own frame. Points with z ≠ 0 are
/// not allowed. Views of fewer than four corners, or of corners on one line, are left out. Fails, naming the camera,
/// when one has no view left, or sees no board at the same time as the others.
/// @param sizes of the cameras' pictures
Result<RefinedRig> CalibrateFromPlanes(std::span<const PictureSize> sizes, std::span<const TargetView> views,
                                       const RefineOptions& options = {});

/// Finds the places of flat boards that bring known cameras' residuals to their least: `cameras` as they are, lenses
/// undone, whatever their world. Views as with `CalibrateFromPlanes`. Fails when no camera shows a board.
Result<RefinedRig> PlaceBoards(std::span<const Camera> cameras, std::span<const TargetView> views);

}  // namespace etude
