#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "reports/films/capture_panel.h"
#include "reports/films/film.h"

namespace etude {

/// Draws two moments of a capture as both cameras saw them, with mask and recovered skeleton.
std::vector<Picture> DrawStrip(const CapturePanel& capture, Renderer& renderer);

/// Saves the same moments with colour, depth and labels, as EXR files for other programs.
Result<void> SaveStripPictures(const CapturePanel& capture, Renderer& renderer, const std::filesystem::path& folder);

/// Draws every stage of a capture's moments in the layout of paper B's figures 5.3 to 5.14: for each moment and camera
/// the picture, the person cut out of it, the marks, the skeleton with its lengths fixed, and after inverse kinematics;
/// beneath, as in figure 5.15, the whole motion as the cameras saw it, and its skeletons. At most two cameras. Nothing
/// when the recording keeps no moments.
std::optional<Picture> DrawPlate(const CapturePanel& capture, Renderer& renderer);

}  // namespace etude
