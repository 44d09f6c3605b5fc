#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"

namespace etude {

/// Writes the cameras of a rig as Pose2Sim's calibration file (TOML; Pagnon et al. 2021): one table for each camera
/// with `name`, `size`, `matrix`, `distortions` (k1, k2, p1, p2; and k3 if there is one), `rotation` (Rodrigues'
/// vector) and `translation` (metres) of the world in the camera's frame, and `fisheye`. Pixel coordinates are
/// OpenCV's. Pose2Sim's world has Z up, our world Y: the point (x, y, z) of Pose2Sim is the point (y, z, x) in our
/// world. Motions that Pose2Sim triangulates and rotates to Y up are therefore in our world.
std::string WritePose2SimCalibration(std::span<const NamedCamera> cameras);

/// Reads a file of WritePose2SimCalibration, Pose2Sim, Anipose, FreeMoCap or Caliscope. Each table describes one camera
/// with the keys of WritePose2SimCalibration; it is named like `[cam_01]` or `[cameras.1]` (which becomes "cam_1").
/// `rotation` is Rodrigues' vector or a matrix. A list may continue over several lines. Other tables (`metadata`) and
/// Caliscope's ignored cameras are skipped. The files contain neither unit nor axes: metres and Pose2Sim's Z up are
/// assumed. A camera that is only planned has `size`, `fov_deg` (horizontal), `position` and `look_at` (the point in
/// the middle of its picture) instead *(ours)*, and no other keys but `name` and `ignore`. Fails, naming line and
/// camera, if a table lacks one of the keys or its values do not describe a camera.
Result<std::vector<NamedCamera>> ReadPose2SimCalibration(std::string_view text);

}  // namespace etude
