#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "tools/capture/capture_parts.h"

namespace etude {

/// Reads the masks of one film from the entry of `folder` that has the film's name: a folder of PNG files, one for each
/// frame in order of their names, or a film. They may be 0 and 1, 0 and 255, soft (the person from 128 on), or indexed:
/// numbers of at most 16, or palettes; then `id` says which number is the person. The lens distortion and the view's
/// fit are undone, and every pixel of the result is the person if half of the pixels that it covers are. Reports empty
/// masks and masks of several regions. Fails, naming the file, for masks of another size or number than the film's
/// frames, for several numbers without `id`, and if all masks are empty.
Result<std::vector<Mask>> ReadMasks(const std::string& folder, std::optional<int> id, const FilmedView& view,
                                    MessageLog& told);

}  // namespace etude
