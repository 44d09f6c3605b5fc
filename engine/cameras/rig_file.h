#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/cameras/pose2sim_file.h"

namespace etude {

/// Reads the cameras of a calibration exported by Qualisys Track Manager (XML, `.qca.txt`), named by their serial
/// numbers. Intrinsics are in pixels or, for QTM's video cameras, in 1/64 pixel; a sensor range above 16384 means 1/64
/// pixel. Distortion coefficients are plain numbers in both cases (Pose2Sim's converter divides them by 64, too, which
/// removes nearly all distortion). Poses are in millimetres, Z up, with the camera's y up and z backwards; ours are in
/// metres, Y up: QTM's (x, y, z) is our (y, z, x), as in ReadPose2SimCalibration. The picture is `fov_video` if
/// present, otherwise the whole sensor, in the sensor's orientation: a `viewrotation` rotates only the displayed
/// picture, and the reader of the pictures must apply it. Fails, with the line, if the text is not such a file or its
/// numbers are not those of a camera.
Result<std::vector<NamedCamera>> ReadQualisysCalibration(std::string_view text);

/// Writes a rig as one YAML file that OpenCV's cv::FileStorage can read, too: `cameras` lists the names, and each name
/// is a key with the content of WriteOpenCvCamera: `fs["left"]["camera_matrix"]`. The world is ours: metres, Y up;
/// pixels are OpenCV's, with the centre of the first pixel at (0, 0). In names, characters that FileStorage does not
/// allow become '_', and "camera_" is put before a leading digit.
std::string WriteRig(std::span<const NamedCamera> cameras);

/// The content of a calibration file; its world is assumed to have the usual unit and axes of the format.
struct RigFile {
  /// The cameras, in metres, Y up. A picture of 0 × 0 pixels means that the file does not state the picture's size.
  std::vector<NamedCamera> cameras;
  std::string format;    ///< name of the format, for users
  glm::dmat3 R_WF{1};    ///< rotates from the file's axes to the world of `cameras`
  double unit_m = 1;     ///< assumed length of the file's unit, metres
  bool has_unit = true;  ///< false: lengths have no unit (COLMAP)
};

/// Reads a rig from one file. The format is recognised by its content:
/// - a file of WriteRig, or one camera in OpenCV's format (WriteOpenCvCamera), which is named "camera";
/// - TOML of Pose2Sim, Anipose, FreeMoCap or Caliscope (ReadPose2SimCalibration);
/// - XML of Qualisys Track Manager (ReadQualisysCalibration).
/// Fails with the position in the file, what was found and what is allowed; refuses more than 64 cameras or 1 MiB.
Result<RigFile> ReadRigFile(std::string_view text, const std::string& file);

/// Reads a rig from two files (`rig_pairs.h`): EasyMocap's `intri.yml` and `extri.yml`, OpenCV's stereo
/// `intrinsics.yml` and `extrinsics.yml`, COLMAP's `cameras.txt` and `images.txt`. `file` and `outside_file` are the
/// names of the two files, for errors.
Result<RigFile> ReadRigPair(std::string_view inside, std::string_view outside, const std::string& file,
                            const std::string& outside_file);

/// Returns only the cameras of ReadRigFile.
Result<std::vector<NamedCamera>> ReadRig(std::string_view text, const std::string& file);

}  // namespace etude
