#pragma once

#include <filesystem>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/keypoints/pixel_fit.h"
#include "io/films/decoder.h"

namespace etude {

/// Returns a pinhole camera that takes the pictures of `camera` without lens distortion, reduced until the longer side
/// has `side` pixels. Smaller pictures are not enlarged.
Camera ReducedCamera(const Camera& camera, int side);

/// The film's pixels that one reduced pixel covers: left ≤ x < right, top ≤ y < bottom.
struct FilmPatch {
  int left = 0, top = 0, right = 0, bottom = 0;
};
/// Returns the patch of every pixel of `ReducedCamera`; a patch outside of the film is empty.
Image<FilmPatch> PatchesOf(const FilmFacts& facts, const Camera& camera, const PixelFit& fit, int side);

/// Reads at most `max_pictures` pictures of a film, and reduces them to the pictures of `ReducedCamera`: the lens
/// distortion and `fit` are undone, and every pixel is the mean of the film's pixels that it covers. Pixels outside the
/// film are black. `camera` is the rig's camera with its lens.
Result<std::vector<ColourImage>> ReadReduced(const std::filesystem::path& path, const FilmFacts& facts,
                                             const Camera& camera, const PixelFit& fit, int side,
                                             std::size_t max_pictures);

}  // namespace etude
