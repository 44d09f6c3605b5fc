#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "engine/base/result.h"

namespace etude {

/// Makes the failed state of any Result by a fault of this machine. What hinders us from asking a method is no answer
/// of it.
template <typename... Args>
tl::unexpected<Error> FailOfMachine(fmt::format_string<Args...> format, Args&&... args) {
  return tl::unexpected<Error>(Error{{}, fmt::format(format, std::forward<Args>(args)...), ErrorKind::kMachine});
}

/// The same error as one of this machine, its place in its message.
inline Error OfThisMachine(const Error& error) { return {{}, ToString(error), ErrorKind::kMachine}; }
inline bool IsOfThisMachine(const Error& error) { return error.kind == ErrorKind::kMachine; }

/// Makes the error of a file or folder that cannot be written, by an errno: "PATH: WHAT: No space left on device". It
/// is the machine's (full, limited, read-only, forbidden), but where the name itself is at fault: a file where a folder
/// must be, a folder that is not there, a name that is too long.
tl::unexpected<Error> CannotWrite(const std::string& path, std::string_view what, int reason);
/// Makes the error of a file or folder that cannot be read. It is the input's, but where the machine lacks something:
/// memory, open files, a disk that answers.
tl::unexpected<Error> CannotRead(const std::string& path, std::string_view what, int reason);

}  // namespace etude
