#pragma once

#include "bench/scenario/scenario.h"
#include "engine/document/fields.h"

namespace etude {

/// A name that can be part of a cell's identity and of a file's name: letters, digits, '-', '_' and '.'.
std::string ReadPlainName(Fields& fields, std::string_view key);

/// Reads `methods`: what every method has (its name, whom it is compared with) and all of those outside.
/// Complaints stay in `fields`.
std::vector<MethodEntry> ReadMethods(Fields& fields, const TaskKind& kind);

}  // namespace etude
