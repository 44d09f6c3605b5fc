#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/base/image.h"
#include "engine/base/result.h"

namespace etude {

// Only jpeg.cc uses libjpeg(-turbo). This library's integer transforms give the same bytes on every processor, with or
// without vector instructions.

/// Returns the bytes of a baseline JPEG file with the standard tables; colours have half the resolution (4:2:0).
/// @param quality 1…100
std::string EncodeJpeg(const ColourImage& picture, int quality);

/// Decodes a file that EncodeJpeg made, into `picture`, whose memory is reused.
void DecodeJpeg(const std::string& jpeg, ColourImage& picture);

/// Reads a JPEG file from any source. Fails for pictures of more than `max_pixels`, before memory is allocated, and for
/// damaged or truncated files.
Result<ColourImage> ReadJpeg(std::string_view jpeg, std::size_t max_pixels);

}  // namespace etude
