#pragma once

#include <optional>
#include <string>

#include "engine/base/image.h"
#include "sim/render/renderer.h"

namespace etude {

// Reads pictures that the program writes, by the same libraries. Nothing when the file is no such picture.

std::optional<ColourImage> ReadColourPng(const std::string& path);
/// Pictures whose channels the file lacks stay empty.
std::optional<View> ReadExr(const std::string& path);

}  // namespace etude
