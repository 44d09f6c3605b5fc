#pragma once

#include <fmt/core.h>

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace etude {

/// A position in a file. Line and column count from 1; 0 means "unknown".
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};

/// The cause of an error.
enum class ErrorKind {
  kInput,
  kMachine,  ///< caused by this machine: no process can be started, the disk is full (machine.h)
};

/// An error with a message for the user: the position in the input, what was found, what is allowed.
struct Error {
  Place place;
  std::string message;
  ErrorKind kind = ErrorKind::kInput;
};

/// Formats "file:line:column: message" without the unknown parts. An error of the machine begins with "this machine: ".
/// The text is one line and safe to show (Visible).
std::string ToString(const Error& error);
std::string ToString(const Place& place);

/// A value, or the reason why bad input gave no value. Our own bugs are assertions and numerical outcomes are status
/// enums; neither is an Error.
template <typename T>
using Result = tl::expected<T, Error>;

/// Returns the failed state of any Result: `return Fail(place, "found {}; allowed: {}", a, b);`
template <typename... Args>
tl::unexpected<Error> Fail(Place place, fmt::format_string<Args...> format, Args&&... args) {
  return tl::unexpected<Error>(Error{std::move(place), fmt::format(format, std::forward<Args>(args)...)});
}

}  // namespace etude

/// Returns the error of a Result from the calling function, if there is one: `RETURN_IF_ERROR(fields.Finish());`
#define RETURN_IF_ERROR(...)                                   \
  do {                                                         \
    if (auto etude_result_ = (__VA_ARGS__); !etude_result_) {  \
      return tl::unexpected(std::move(etude_result_).error()); \
    }                                                          \
  } while (false)

/// Declares the value of a Result, or returns its error from the calling function:
/// `ASSIGN_OR_RETURN(const auto clip, ReadBvh(text, file));`
#define ASSIGN_OR_RETURN(declaration, ...) \
  ETUDE_ASSIGN_OR_RETURN_(ETUDE_UNIQUE_(etude_result_, __COUNTER__), declaration, __VA_ARGS__)
#define ETUDE_ASSIGN_OR_RETURN_(result, declaration, ...)        \
  auto result = (__VA_ARGS__);                                   \
  if (!result) return tl::unexpected(std::move(result).error()); \
  declaration = *std::move(result)
#define ETUDE_UNIQUE_(name, number) ETUDE_UNIQUE_NAME_(name, number)
#define ETUDE_UNIQUE_NAME_(name, number) name##number
