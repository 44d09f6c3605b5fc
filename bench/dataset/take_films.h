#pragma once

#include <span>

#include "bench/model/payload.h"
#include "engine/base/result.h"
#include "io/files/file_path.h"

namespace etude {

/// Writes the takes among `files` into `folder`, each as a film: `camera-1-0000.png`, `camera-1-0001.png`, … (in this
/// order, PNG) become `camera-1.mp4`. Fails if ffmpeg does, for instance at odd widths.
Result<void> SaveTakeFilms(std::span<const Attachment> files, int rate_hz, const FilePath& folder);

}  // namespace etude
