#pragma once

#include <span>

#include "bench/model/payload.h"
#include "engine/base/result.h"
#include "io/files/file_path.h"

namespace etude {

/// Writes each take among `files` as a film into `folder`: the consecutive pictures `camera-1-0000.png`,
/// `camera-1-0001.png`, … become `camera-1.mp4`. Fails on invalid PNG, and if ffmpeg fails (at odd widths, for
/// instance).
Result<void> SaveTakeFilms(std::span<const Attachment> files, int rate_hz, const FilePath& folder);

}  // namespace etude
