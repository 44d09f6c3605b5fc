#pragma once

#include <string>
#include <string_view>

namespace etude {

/// A name in one line of UTF-8, which is what JSON holds: other bytes and control characters become '?'. Names from
/// other formats may be anything; those of glTF files reach terminals and tables.
std::string GltfText(std::string_view name);

}  // namespace etude
