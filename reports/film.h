#pragma once

#include <filesystem>

#include "bench/results/run_data.h"
#include "reports/media.h"

namespace etude {

/// Where files go that stand beside the page.
struct MediaPaths {
  std::filesystem::path film;      ///< the MP4
  std::filesystem::path pictures;  ///< a folder: colour, depth and labels of the strip's moments, as EXR
};

/// Draws what the recordings of a run show: the film, its poster, the strip and the pictures behind it.
/// Whatever cannot be made is left out, with the reason in `why_no_film`; never a failure of the report.
Media MakeMedia(const RunData& run, const MediaPaths& paths);

}  // namespace etude
