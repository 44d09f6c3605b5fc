#pragma once

#include <filesystem>
#include <vector>

#include "reports/films/capture_panel.h"
#include "reports/films/media.h"

namespace etude {

/// Two moments of a capture, as both cameras saw them, with mask and recovered skeleton.
std::vector<Picture> DrawStrip(const CapturePanel& capture, Renderer& renderer);

/// The same moments with everything that is known of them, as EXR files for other programs.
Result<void> SaveStripPictures(const CapturePanel& capture, Renderer& renderer, const std::filesystem::path& folder);

}  // namespace etude
