#pragma once

#include <string>

#include "engine/base/image.h"

namespace etude {

// The one door to libjpeg(-turbo). Its integer transforms give the same bytes on every processor, whether it has vector
// instructions or not.

/// The bytes of a baseline JPEG file, colours at half the resolution (4:2:0), with the standard tables.
/// @param quality 1…100
std::string EncodeJpeg(const ColourImage& picture, int quality);

/// What is left of the picture afterwards. `jpeg` comes from EncodeJpeg.
void DecodeJpeg(const std::string& jpeg, ColourImage& picture);

}  // namespace etude
