#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// Parses JSON of unknown origin. Returns an error with the position of the first byte that is not valid JSON. A zero
/// byte is refused, too, because the parser would treat it as the end of the text.
Result<nlohmann::json> ParseJsonText(std::string_view text, const std::string& file);

}  // namespace etude
