#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// Refuses text that is not UTF-8 (RFC 3629: no surrogates, no overlong forms, up to U+10FFFF), or holds a zero byte,
/// with the place of the first byte that is wrong.
Result<void> CheckUtf8(std::string_view text, const std::string& file);

}  // namespace etude
