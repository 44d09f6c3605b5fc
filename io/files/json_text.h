#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "io/files/json.h"

namespace etude {

/// Why a text is not JSON: the byte at which that shows, counted from 1.
struct JsonFault {
  std::size_t byte = 0;
  bool is_large_number = false;  ///< it is JSON, with a number that no double holds
};

/// A text that somebody else wrote, parsed.
struct JsonText {
  Json value;                                    ///< of a key that stands twice, both
  std::optional<std::string> repeated_key = {};  ///< the first that stands twice in one object
  std::optional<JsonFault> fault = {};           ///< then the rest says nothing
};

/// Parses a text in time proportional to its length, whatever stands in it: nlohmann's own parser looks up every key
/// among those before it, and with a callback goes through a list once more for each of its objects.
JsonText ParseJsonText(std::string_view text);

}  // namespace etude
