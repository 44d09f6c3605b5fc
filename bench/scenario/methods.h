#pragma once

#include "bench/scenario/scenario.h"
#include "engine/document/fields.h"

namespace etude {

/// True when a name can be part of a cell's identity and of a file's name: letters, digits, '_', and behind the
/// first character '-' and '.', at most 80.
bool IsPlainName(const std::string& name);
/// A plain name as the value of a key.
ValueKind PlainNameKind();
/// Reads such a name.
std::string ReadPlainName(Fields& fields, std::string_view key);

/// The keys of a method outside; a built-in one has `name`, `against` and `description` of them, and its task's.
const FieldTable<MethodEntry>& OutsideMethodFields();

/// Reads `methods`: what every method has (its name, whom it is compared with) and all of those outside.
/// Complaints stay in `fields`.
std::vector<MethodEntry> ReadMethods(Fields& fields, const TaskKind& kind);

}  // namespace etude
