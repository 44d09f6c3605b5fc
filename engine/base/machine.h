#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// The place of errors that the machine caused, not the input and not a method: no process can be started, the
/// disk is full. What hinders us from asking a method is no answer of it.
constexpr const char* kThisMachine = "this machine";

/// The same error as one of this machine.
inline Error OfThisMachine(const Error& error) { return {{kThisMachine, 0, 0}, ToString(error)}; }
inline bool IsOfThisMachine(const Error& error) { return error.place.file == kThisMachine; }

/// Makes the error of a file or folder that cannot be written, by an errno: "PATH: WHAT: No space left on device". It
/// is the machine's (full, limited, read-only, forbidden), but where the name itself is at fault: a file where a folder
/// must be, a folder that is not there, a name that is too long.
tl::unexpected<Error> CannotWrite(const std::string& path, std::string_view what, int reason);
/// Makes the error of a file or folder that cannot be read. It is the input's, but where the machine lacks something:
/// memory, open files, a disk that answers.
tl::unexpected<Error> CannotRead(const std::string& path, std::string_view what, int reason);

}  // namespace etude
