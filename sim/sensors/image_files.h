#pragma once

#include <string>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "sim/render/renderer.h"

namespace etude {

// Pictures as files: the one door to PNG and OpenEXR. Every error names the file.

/// The bytes of a PNG file; the same for the same picture. `image` has at least one pixel.
std::string EncodePng(const ColourImage& image);

/// The bytes of an OpenEXR file (ZIP, lossless) with the channels R, G, B (half; the 8-bit values / 255, not
/// linearised), Z (float, metres along the viewing axis) and label (uint). Empty pictures of `view` are
/// left out; the others have one size. The same for the same view.
Result<std::string> EncodeExr(const View& view);
Result<void> SaveExr(const View& view, const std::string& path);

}  // namespace etude
