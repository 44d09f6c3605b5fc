#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// Somebody else's JSON. Refused with the place from which on it is none, a zero byte included, which the parser would
/// take for the end of the text.
Result<nlohmann::json> ParseJsonText(std::string_view text, const std::string& file);

}  // namespace etude
