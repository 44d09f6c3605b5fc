#pragma once

#include <filesystem>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/keypoints/pixel_fit.h"
#include "io/films/decoder.h"

namespace etude {

/// Gives the pinhole whose pictures are the camera's, made smaller until their longer side has `side` pixels; never
/// larger.
Camera ReducedCamera(const Camera& camera, int side);

/// Reads a film's pictures as `ReducedCamera` would take them: the lens undone, `fit` undone, every pixel the mean of
/// the film's that it covers; black where the film shows nothing. At most `most` of them. `camera` is the rig's, with
/// its lens.
Result<std::vector<ColourImage>> ReadReduced(const std::filesystem::path& path, const FilmFacts& facts,
                                             const Camera& camera, const PixelFit& fit, int side, std::size_t most);

}  // namespace etude
