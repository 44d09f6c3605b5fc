#pragma once

#include <optional>
#include <span>
#include <vector>

namespace etude {

/// Holm's step-down correction (1979): each p as if it alone had been asked, so that among all of them one is wrongly
/// at most alpha with probability alpha. A missing p counts in the number of questions, and stays missing.
std::vector<std::optional<double>> HolmCorrected(std::span<const std::optional<double>> p_values);

}  // namespace etude
