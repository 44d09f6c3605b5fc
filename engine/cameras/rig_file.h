#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/cameras/pose2sim_file.h"

namespace etude {

/// Reads the cameras of a calibration that Qualisys Track Manager exported (XML, `.qca.txt`), named by their serial
/// numbers. Lengths inside a camera are pixels, or 1/64 of them, as QTM writes for its video cameras: told apart by the
/// sensor's range, beyond 16384. Distortion coefficients are plain numbers either way (Pose2Sim's converter divides
/// them by 64, too, which leaves next to nothing of the lens). Poses are millimetres, Z up, the camera's y up and z
/// behind; ours is metres, Y up: QTM's (x, y, z) is our (y, z, x), as with ReadPose2SimCalibration. The picture is
/// `fov_video`, where there is one, else the whole sensor. Fails, with line, for what is no such file, cameras whose
/// pictures are turned (`viewrotation`; export them unturned), and numbers that are no camera's.
Result<std::vector<NamedCamera>> ReadQualisysCalibration(std::string_view text);

/// Writes a rig as one YAML file that OpenCV's cv::FileStorage reads, too: `cameras` lists the names, and under each
/// name stand the keys of WriteOpenCvCamera: `fs["left"]["camera_matrix"]`. The world is ours: metres, Y up; pixels are
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
