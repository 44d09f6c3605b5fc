#pragma once

#include "bench/scenario/scenario.h"
#include "engine/document/fields.h"

namespace etude {

/// Returns true if a name may be part of a cell's identity and of a file's name: letters, digits, '_', and after the
/// first character '-' and '.', at most 80 characters.
bool IsPlainName(const std::string& name);
ValueKind PlainNameKind();
std::string ReadPlainName(Fields& fields, std::string_view key);

/// The keys of an outside method. Of these, a built-in method has `name`, `against` and `description`; its other keys
/// are those of its task.
const FieldTable<MethodEntry>& OutsideMethodFields();

/// Reads `methods`: the keys that every method has, and all keys of outside methods. Complaints stay in `fields`.
std::vector<MethodEntry> ReadMethods(Fields& fields, const TaskKind& kind);

}  // namespace etude
