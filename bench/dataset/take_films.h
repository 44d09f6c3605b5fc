#pragma once

#include <span>
#include <string_view>

#include "bench/model/payload.h"
#include "engine/base/result.h"
#include "io/files/file_path.h"

namespace etude {

/// Returns true if the file with this name is a picture of a take: `camera-1-0042.png`.
bool IsPictureOfTake(std::string_view name);

/// Writes each take among `files` as a lossless film into `folder`: the consecutive pictures `camera-1-0000.png`,
/// `camera-1-0001.png`, … become the frames of `camera-1.mkv`. Fails on invalid PNG, and if ffmpeg fails.
Result<void> SaveTakeFilms(std::span<const Attachment> files, int rate_hz, const FilePath& folder);

}  // namespace etude
