#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "tools/capture/capture_parts.h"

namespace etude {

/// Reads the masks of one film from the entry of `folder` that has the film's name: a film, or a folder of PNG files,
/// one per frame in the order of their names. Values may be 0 and 1; 0 and 255; soft (the person from 128 on); or
/// numbers of regions, up to 16 or by a palette: then `id` is the person's number. Returns one mask per frame, in the
/// pixels of the view's reduced camera, without lens distortion. A pixel is the person if at least half of the film's
/// pixels that it covers are. Reports empty masks and masks of several regions. Fails, naming the file, if size or
/// number of the masks differ from those of the film's frames, for several numbers without `id`, and if all masks are
/// empty.
Result<std::vector<Mask>> ReadMasks(const std::string& folder, std::optional<int> id, const FilmedView& view,
                                    MessageLog& told);

}  // namespace etude
