#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bench/model/run_data.h"

namespace etude {

/// A verdict as a coloured label of HTML: sign and word, so that colour says nothing alone. Without a verdict "it
/// depends" on the condition.
std::string VerdictBadge(const std::optional<Verdict>& verdict);

/// The sign alone: "▲", "▼", "=", "?"; "±" when it depends.
std::string_view VerdictSign(const std::optional<Verdict>& verdict);
/// The sign as HTML in the label's colour; its word is for who cannot see it.
std::string VerdictMark(Verdict verdict);

}  // namespace etude
