#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/cameras/pose2sim_file.h"

namespace etude {

/// A rig as one file that OpenCV's cv::FileStorage reads, too (YAML): `cameras` lists the names, and under each name
/// stand the keys of WriteOpenCvCamera: `fs["left"]["camera_matrix"]`. The world is ours: metres, Y up; pixels are
/// OpenCV's, the centre of the first one at (0, 0). In names, what FileStorage does not allow becomes '_', and
/// "camera_" stands before a first digit.
std::string WriteRig(std::span<const NamedCamera> cameras);

/// Reads the cameras of a rig from any of the files that are in use, told apart by what is in them:
/// - what WriteRig has written; or one camera as OpenCV writes it (WriteOpenCvCamera), named "camera";
/// - TOML of Pose2Sim or Anipose (ReadPose2SimCalibration);
/// - XML of Qualisys Track Manager (ReadQualisysCalibration).
/// Fails with the place, what was found and what is allowed; over 64 cameras or 1 MiB are refused.
Result<std::vector<NamedCamera>> ReadRig(std::string_view text, const std::string& file);

}  // namespace etude
