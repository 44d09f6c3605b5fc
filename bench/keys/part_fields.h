#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "bench/keys/field_table.h"

namespace etude {

enum class Keep { kThese, kOthers };

/// Those fields of another table, or all but those, read into a part of `Options`: a key that two tasks have is told
/// once. `part` is a member, or a function that gives one.
template <typename Options, typename Part, typename Member>
std::vector<Field<Options>> FieldsOf(const FieldTable<Part>& table, Member part, Keep keep,
                                     const std::vector<std::string>& keys) {
  std::vector<Field<Options>> fields;
  for (const Field<Part>& field : table.fields) {
    const bool named = std::ranges::find(keys, field.info.key) != keys.end();
    if (named != (keep == Keep::kThese)) continue;
    fields.push_back({field.info, [field, part](Fields& mapping, Options& options) {
                        field.read(mapping, std::invoke(part, options));
                      }});
  }
  return fields;
}

template <typename Options>
void Append(std::vector<Field<Options>> more, std::vector<Field<Options>>& fields) {
  std::ranges::move(more, std::back_inserter(fields));
}

}  // namespace etude
