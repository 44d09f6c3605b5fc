#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/rig_file.h"
#include "engine/document/node.h"

namespace etude {

/// Reads the numbers of a matrix that OpenCV wrote into YAML under `key`. Fails if it is not a matrix, and, unless
/// `rows` is 0, if the count is not rows × columns.
Result<std::vector<double>> MatrixAt(const Node& camera, std::string_view key, std::size_t rows, std::size_t columns);

/// Reads EasyMocap's two files: `names`, `K_<name>`, `dist_<name>` (and `H_<name>`, `W_<name>`) from intri.yml;
/// `T_<name>`, and `Rot_<name>` or `R_<name>`, from extri.yml. The files' world is the frame of EasyMocap's
/// chessboard, Z up, in metres; `RigFile::R_WF` rotates it.
Result<RigFile> ReadEasyMocap(const Node& intrinsics, const Node& extrinsics);

/// Reads OpenCV's two files of a stereo rig: M1, D1, M2, D2 from intrinsics.yml; R and T, which map from the first
/// camera's frame to the second's, from extrinsics.yml. The files' world is the first camera's frame, which
/// `RigFile::R_WF` rotates; the cameras are named "left" and "right". Rectification matrices are ignored because the
/// films are not rectified.
Result<RigFile> ReadOpenCvStereo(const Node& intrinsics, const Node& extrinsics);

/// Reads COLMAP's text model with one image for each camera; the image's name, without folder and extension, becomes
/// the camera's name. If images in different folders have the same name, every camera gets the name of its image's
/// folder instead. The centre of COLMAP's first pixel is (0.5, 0.5), as in our coordinates. COLMAP's lengths have no
/// unit. Errors in `images` are reported with the file name `images_file`.
Result<RigFile> ReadColmap(std::string_view cameras, std::string_view images, const std::string& images_file);

}  // namespace etude
