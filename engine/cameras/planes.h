#pragma once

#include <glm/glm.hpp>
#include <span>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/cameras/refine.h"

namespace etude {

/// Computes the homography from a plane to its picture, (u·w, v·w, w)ᵀ = H (x, y, 1)ᵀ for points (x, y, 0), by the
/// normalised direct linear transform. The scale of H is arbitrary. Fails for fewer than four points, for points that
/// lie (nearly) on one line, and for points that are not finite.
Result<glm::dmat3> HomographyOf(std::span<const PointPair> pairs);

/// Estimates the focal lengths of a camera from homographies of planes (Zhang 2000, section 3.1). The principal point
/// is assumed in the middle of the picture; skew and distortion are assumed to be zero. The result is a start for
/// `RefineRig`. Fails if all planes are parallel to the picture, because the focal length is then undetermined.
Result<Intrinsics> IntrinsicsFromPlanes(std::span<const glm::dmat3> homographies, int width, int height);

/// Returns the pose of the plane in the camera's frame (R_CT, p_CT), in front of the camera.
CalibrationTargetPose PoseOfPlane(const Intrinsics& intrinsics, const glm::dmat3& homography);

struct PictureSize {
  int width = 0;
  int height = 0;
};

/// Numbers the targets of the views from 0 without gaps, in order of appearance; returns the number of targets.
std::size_t NumberTargets(std::span<TargetView> views);

/// Calibrates cameras from flat boards in their pictures. Each camera's intrinsics follow from its homographies; poses
/// follow from boards that two cameras see at the same time; then `RefineRig` adjusts all cameras and boards together.
/// A target is a board in one pose; the frame of the first target in `views` is the world. Points must have z = 0.
/// Views with fewer than four corners, or with corners on one line, are left out. Fails, naming the camera, if a camera
/// has no view left, or never sees a board at the same time as another camera.
/// @param sizes the size of each camera's pictures
Result<RefinedRig> CalibrateFromPlanes(std::span<const PictureSize> sizes, std::span<const TargetView> views,
                                       const RefineOptions& options = {});

/// Finds the poses of flat boards by minimising the reprojection error in pictures of known cameras. The cameras, with
/// their lenses, are not changed; they may be given in any world frame. Views are selected as in `CalibrateFromPlanes`.
/// Fails if no camera shows a board.
Result<RefinedRig> LocateBoards(std::span<const Camera> cameras, std::span<const TargetView> views);

}  // namespace etude
