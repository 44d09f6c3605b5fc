#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// The place of errors that the machine caused rather than the input or a method: no process can be started, the disk
/// is full. Such an error is not an answer of the method.
constexpr const char* kThisMachine = "this machine";

/// Returns the same error, attributed to this machine.
inline Error OfThisMachine(const Error& error) { return {{kThisMachine, 0, 0}, ToString(error)}; }
inline bool IsOfThisMachine(const Error& error) { return error.place.file == kThisMachine; }

/// Returns the error for a file or folder that cannot be written, from an errno: "PATH: WHAT: No space left on device".
/// It is attributed to the machine (full, limited, read-only, forbidden), unless the name is at fault: a file where a
/// folder is needed, a missing folder, a name that is too long.
tl::unexpected<Error> CannotWrite(const std::string& path, std::string_view what, int reason);
/// Returns the error for a file or folder that cannot be read. It is attributed to the input, unless the machine lacks
/// memory, open files or a working disk.
tl::unexpected<Error> CannotRead(const std::string& path, std::string_view what, int reason);

}  // namespace etude
