#pragma once

#include <functional>
#include <string>

namespace etude {

/// What CLI11 asks whether a value is allowed: an empty answer, or the complaint.
using Check = std::function<std::string(const std::string& text)>;

/// A number from `low` to `high`; CLI::Range would let NaN through. `kind` is what the number is: "rate".
Check NumberWithin(double low, double high, const std::string& kind);

}  // namespace etude
