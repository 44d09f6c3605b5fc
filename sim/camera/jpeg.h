#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/base/image.h"
#include "engine/base/result.h"

namespace etude {

// The one door to libjpeg(-turbo). Its integer transforms give the same bytes on every processor, whether it has vector
// instructions or not.

/// Returns the bytes of a baseline JPEG file, colours at half the resolution (4:2:0), with the standard tables.
/// @param quality 1…100
std::string EncodeJpeg(const ColourImage& picture, int quality);

/// Decodes a file that EncodeJpeg made; the memory of `picture` is used again.
void DecodeJpeg(const std::string& jpeg, ColourImage& picture);

/// Reads a JPEG file of any origin. Pictures of more than `most_pixels` are refused before memory is taken; a file that
/// breaks off counts as damaged.
Result<ColourImage> ReadJpeg(std::string_view jpeg, std::size_t most_pixels);

}  // namespace etude
