#pragma once

#include <optional>
#include <string_view>

namespace etude {

/// Returns the metres in one unit of length, by its abbreviation (m, cm, mm, in, ft) or its English name in the
/// singular or plural, in any case; nullopt for other texts.
std::optional<double> MetresOfUnit(std::string_view name);

}  // namespace etude
