#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "engine/base/result.h"

namespace etude {

/// Makes the failed state of any Result for an error that the machine caused rather than the input or a method: no
/// process can be started, the disk is full. Such an error does not count as a result of the method.
template <typename... Args>
tl::unexpected<Error> FailOfMachine(fmt::format_string<Args...> format, Args&&... args) {
  Error error;
  error.message = fmt::format(format, std::forward<Args>(args)...);
  error.kind = ErrorKind::kMachine;
  return tl::unexpected<Error>(std::move(error));
}

/// Returns the error as one that this machine caused; the position of the error becomes part of the message.
inline Error OfThisMachine(const Error& error) { return {{}, ToString(error), ErrorKind::kMachine}; }
inline bool IsOfThisMachine(const Error& error) { return error.kind == ErrorKind::kMachine; }

/// Returns the error for a file or folder that cannot be written, from an errno: "PATH: WHAT: No space left on device".
/// It is attributed to the machine (full disk, quota, read-only disk, no permission), unless the name is the cause: a
/// file where a folder is needed, a missing folder, a name that is too long.
tl::unexpected<Error> CannotWrite(const std::string& path, std::string_view what, int reason);
/// Returns the error for a file or folder that cannot be read. It is attributed to the input, unless the machine lacks
/// memory, open files or a working disk.
tl::unexpected<Error> CannotRead(const std::string& path, std::string_view what, int reason);

}  // namespace etude
