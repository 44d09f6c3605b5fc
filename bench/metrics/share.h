#pragma once

#include <cstdint>
#include <optional>

namespace etude {

/// part / whole; empty when there is nothing to be a share of.
inline std::optional<double> Share(std::int64_t part, std::int64_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace etude
