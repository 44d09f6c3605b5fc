#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "tools/capture/capture_parts.h"

namespace etude {

/// Reads the masks of one film from the entry of `folder` that has the film's name: a film, or a folder of PNG files,
/// one per frame in the order of their names. Pixel values may be 0 and 1, or 0 and 255, or shades (128 and above is
/// the person), or region numbers (up to 16, or indices into a palette), of which `id` is the person's. Returns one
/// mask per frame, in the pixels of the view's reduced camera, without lens distortion. A reduced pixel is set if at
/// least half of the film's pixels in its patch (`FilmPatch`) show the person. Reports empty masks and masks of several
/// regions. Fails, naming the file, if the size or the number of masks differs from the film's frames, if there are
/// several region numbers but no `id`, and if all masks are empty.
Result<std::vector<Mask>> ReadMasks(const std::string& folder, std::optional<int> id, const FilmedView& view,
                                    MessageLog& told);

}  // namespace etude
