#include "cli/validators.h"

#include <fmt/format.h>

#include <charconv>

namespace etude {

Check NumberWithin(double low, double high, const std::string& kind) {
  return [=](const std::string& text) -> std::string {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_number = error == std::errc() && end == text.data() + text.size();
    if (is_number && number >= low && number <= high) return "";
    return fmt::format("'{}' is no {}; allowed: {} to {}", text, kind, low, high);
  };
}

}  // namespace etude
