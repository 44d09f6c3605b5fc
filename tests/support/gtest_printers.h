#pragma once

#include <ostream>

#include "engine/base/result.h"

namespace etude {

/// Makes a failed expectation on a Result print the error message instead of raw bytes.
inline void PrintTo(const Error& error, std::ostream* out) { *out << ToString(error); }

}  // namespace etude
