#pragma once

#include <span>
#include <string_view>

#include "bench/model/payload.h"
#include "engine/base/result.h"
#include "io/files/file_path.h"

namespace etude {

/// Returns true if `name` is the file name of a picture of a take, e.g. `camera-1-0042.png`.
bool IsPictureOfTake(std::string_view name);

/// Writes each take among `files` as a lossless film into `folder`: the consecutive pictures `camera-1-0000.png`,
/// `camera-1-0001.png`, … become the frames of `camera-1.mkv`, at `rate_hz` frames per second. Fails if a PNG file is
/// invalid or ffmpeg fails.
Result<void> SaveTakeFilms(std::span<const Attachment> files, double rate_hz, const FilePath& folder);

}  // namespace etude
