#pragma once

#include "bench/scenario/scenario.h"
#include "engine/document/fields.h"

namespace etude {

/// Returns true if a name may be part of a cell's identity and of a file's name: letters, digits and '_', after the
/// first character also '-' and '.', at most 80 characters.
bool IsPlainName(const std::string& name);
ValueKind PlainNameKind();
std::string ReadPlainName(Fields& fields, std::string_view key);

/// Returns the keys of an outside method. A built-in method has only `name`, `against` and `description` of these keys;
/// its other keys are keys of its task.
const FieldTable<MethodEntry>& OutsideMethodFields();

/// Reads `methods`: the keys that every method has, and all keys of outside methods. Errors are collected in `fields`.
std::vector<MethodEntry> ReadMethods(Fields& fields, const TaskKind& kind);

}  // namespace etude
