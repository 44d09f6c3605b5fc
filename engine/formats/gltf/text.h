#pragma once

#include <string>
#include <string_view>

namespace etude {

/// A name as JSON can hold it, which is UTF-8: bytes that are none, and zeros, become '?'. Names from other formats may
/// be anything.
std::string GltfText(std::string_view name);

}  // namespace etude
