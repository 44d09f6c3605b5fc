#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/base/image.h"
#include "engine/base/result.h"

namespace etude {

// The one door to libjpeg(-turbo). Its integer transforms give the same bytes on every processor, whether it has vector
// instructions or not.

/// The bytes of a baseline JPEG file, colours at half the resolution (4:2:0), with the standard tables.
/// @param quality 1…100
std::string EncodeJpeg(const ColourImage& picture, int quality);

/// What is left of the picture afterwards, into memory that is used again. `jpeg` comes from EncodeJpeg.
void DecodeJpeg(const std::string& jpeg, ColourImage& picture);

/// Anybody's JPEG file. Refused before memory is taken: more than `most_pixels`. A picture that breaks off is damaged.
Result<ColourImage> ReadJpeg(std::string_view jpeg, std::size_t most_pixels);

}  // namespace etude
