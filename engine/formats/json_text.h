#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// Parses JSON that others wrote. Refused with the place of the first byte that is no JSON; a zero byte too, which the
/// parser would take for the end of the text.
Result<nlohmann::json> ParseJsonText(std::string_view text, const std::string& file);

}  // namespace etude
