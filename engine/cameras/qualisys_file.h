#pragma once

#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/pose2sim_file.h"

namespace etude {

/// The cameras of a calibration as Qualisys Track Manager exports it (XML, `.qca.txt`), named by their serial numbers.
/// Lengths inside a camera are pixels, or 1/64 of them, as QTM writes for its video cameras: told apart by the sensor's
/// range, beyond 16384. Distortion coefficients are plain numbers either way (Pose2Sim's converter divides them by 64,
/// too, which leaves next to nothing of the lens). Poses are millimetres, Z up, the camera's y up and z behind; ours is
/// metres, Y up: QTM's (x, y, z) is our (y, z, x), as with ReadPose2SimCalibration. The picture is `fov_video`, where
/// there is one, else the whole sensor. Fails, with line, for what is no such file, cameras whose pictures are turned
/// (`viewrotation`; export them unturned), and numbers that are no camera's.
Result<std::vector<NamedCamera>> ReadQualisysCalibration(std::string_view text);

}  // namespace etude
