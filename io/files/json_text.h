#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "io/files/json.h"

namespace etude {

struct JsonFault {
  std::size_t byte = 0;          ///< position at which the parser stopped, counted from 1
  bool is_large_number = false;  ///< true: the text is JSON, but contains a number beyond the range of a double
};

/// A parsed text, which may come from another program.
struct JsonText {
  Json value;                                    ///< contains both entries of a repeated key
  std::optional<std::string> repeated_key = {};  ///< the first key that occurs twice in one object
  std::optional<JsonFault> fault = {};           ///< if set, the other fields have no meaning
};

/// Parses a text in time n log n for any input. nlohmann's own parser takes quadratic time: it compares each key of an
/// object with all earlier keys, and, with a callback, it reads a whole list again for each object in the list.
JsonText ParseJsonText(std::string_view text);

}  // namespace etude
