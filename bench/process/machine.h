#pragma once

#include "engine/base/result.h"

namespace etude {

/// The place of errors that neither the input nor a method has made, but the machine: no process can be started, no
/// folder for temporary files written. What hinders us from asking a method is no answer of it.
constexpr const char* kThisMachine = "this machine";

/// The same error as one of this machine.
inline Error OfThisMachine(const Error& error) { return {{kThisMachine, 0, 0}, ToString(error)}; }
inline bool IsOfThisMachine(const Error& error) { return error.place.file == kThisMachine; }

}  // namespace etude
