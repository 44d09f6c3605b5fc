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
/// `fov_video`, where there is one, else the whole sensor, as the sensor has it: a `viewrotation` turns what is seen of
/// it, and is left to who reads the pictures. Fails, with line, for what is no such file and numbers that are no
/// camera's.
Result<std::vector<NamedCamera>> ReadQualisysCalibration(std::string_view text);

/// Writes a rig as one YAML file that OpenCV's cv::FileStorage reads, too: `cameras` lists the names, and under each
/// name stand the keys of WriteOpenCvCamera: `fs["left"]["camera_matrix"]`. The world is ours: metres, Y up; pixels are
/// OpenCV's, the centre of the first one at (0, 0). In names, what FileStorage does not allow becomes '_', and
/// "camera_" stands before a first digit.
std::string WriteRig(std::span<const NamedCamera> cameras);

/// The content of a calibration, told as if its world had the usual unit and axes of its format.
struct RigFile {
  std::vector<NamedCamera> cameras;  ///< metres, Y up; a picture of 0 x 0 pixels: the file does not tell its size
  std::string format;                ///< as people call it
  glm::dmat3 R_WF{1};                ///< from the file's axes to the cameras' world
  double unit_m = 1;                 ///< metres in the file's unit of length, as they were taken
  bool has_unit = true;              ///< false: lengths mean nothing (COLMAP)
};

/// Reads a rig from one file of those that are in use, told apart by what is in them:
/// - what WriteRig has written; or one camera as OpenCV writes it (WriteOpenCvCamera), named "camera";
/// - TOML of Pose2Sim, Anipose, FreeMoCap or Caliscope (ReadPose2SimCalibration);
/// - XML of Qualisys Track Manager (ReadQualisysCalibration).
/// Fails with the place, what was found and what is allowed; over 64 cameras or 1 MiB are refused.
Result<RigFile> ReadRigFile(std::string_view text, const std::string& file);

/// Reads a rig from two files (`rig_pairs.h`): EasyMocap's `intri.yml` and `extri.yml`, OpenCV's stereo
/// `intrinsics.yml` and `extrinsics.yml`, COLMAP's `cameras.txt` and `images.txt`.
Result<RigFile> ReadRigPair(std::string_view inside, std::string_view outside, const std::string& file);

/// Reads the cameras of ReadRigFile.
Result<std::vector<NamedCamera>> ReadRig(std::string_view text, const std::string& file);

}  // namespace etude
