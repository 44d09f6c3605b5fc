#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// Returns the known name closest to `name` by edit distance (insert, delete, replace, swap neighbours), or an empty
/// string if none is close enough to be a likely typing error.
std::string NearestName(std::string_view name, std::span<const std::string> known);

/// Returns the error message about an unknown name: "unknown solver 'cdc'; did you mean 'ccd'? Allowed: ccd,
/// ccd-hinges".
std::string UnknownName(std::string_view kind, std::string_view name, std::span<const std::string> known);

/// Joins items as in "a, b, c".
std::string Join(std::span<const std::string> items, std::string_view separator = ", ");

/// Returns a name with spaces instead of underscores: left_arm becomes "left arm".
std::string WithSpaces(std::string name);

/// Returns a person's name in the form in which names are compared, because people write one name in different ways:
/// without spaces, with ASCII letters in lower case, and with each accented Latin letter as one character, even if the
/// text has it as two (NFD).
std::string ComparedName(std::string_view name);

/// Formats a word for error messages: quoted, shortened, unprintable characters as `?`; an empty text becomes "the end
/// of the line or file".
std::string Quote(std::string_view text);

}  // namespace etude
