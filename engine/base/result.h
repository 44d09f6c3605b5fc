#pragma once

#include <fmt/core.h>

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace etude {

/// Where in a file something was found. Line and column count from 1; 0 means "not known".
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};

/// Bad input, told to a human: where it is, what was found, what is allowed.
struct Error {
  Place place;
  std::string message;
};

/// "file:line:column: message", leaving out what is not known; one line, control characters made spaces.
std::string ToString(const Error& error);
std::string ToString(const Place& place);

/// A value, or the reason why bad input could not give one. Our own bugs are assertions, and
/// numerical outcomes are status enums: neither travels as an Error.
template <typename T>
using Result = tl::expected<T, Error>;

/// Makes the failed state of any Result: `return Fail(place, "found {}; allowed: {}", a, b);`
template <typename... Args>
tl::unexpected<Error> Fail(Place place, fmt::format_string<Args...> format, Args&&... args) {
  return tl::unexpected<Error>(Error{std::move(place), fmt::format(format, std::forward<Args>(args)...)});
}

}  // namespace etude
