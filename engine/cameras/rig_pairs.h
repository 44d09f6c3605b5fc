#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/rig_file.h"
#include "engine/document/node.h"

namespace etude {

/// Reads the numbers of a matrix that OpenCV wrote into YAML under `key`. Fails for what is none, and for other counts
/// than rows × columns, where `rows` is not 0.
Result<std::vector<double>> MatrixAt(const Node& camera, std::string_view key, std::size_t rows, std::size_t columns);

/// Reads EasyMocap's pair: `names`, `K_<name>`, `dist_<name>` (and `H_`, `W_`) inside; `Rot_<name>` or `R_<name>`,
/// `T_<name>` outside. Its chessboard's world has Z up, in metres.
Result<RigFile> ReadEasyMocap(const Node& intrinsics, const Node& extrinsics);

/// Reads OpenCV's stereo pair: M1, D1, M2, D2 inside; R, T, which lead from the first camera's frame to the second's,
/// outside. The world is the first camera's frame; the cameras are "left" and "right". Rectified matrices are passed
/// over: the films are not rectified.
Result<RigFile> ReadOpenCvStereo(const Node& intrinsics, const Node& extrinsics);

/// Reads COLMAP's text model: one image a camera, which gives it its name (without folders and ending). COLMAP's first
/// pixel has its centre at (0.5, 0.5), as ours. Its lengths have no unit.
Result<RigFile> ReadColmap(std::string_view cameras, std::string_view images);

}  // namespace etude
