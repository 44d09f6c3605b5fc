#pragma once

#include <optional>
#include <string>

#include "bench/results/run_data.h"

namespace etude {

/// A verdict as a coloured label of HTML: sign and word, so that colour says nothing alone. Without a verdict "it
/// depends" on the condition.
std::string VerdictBadge(const std::optional<Verdict>& verdict);

}  // namespace etude
