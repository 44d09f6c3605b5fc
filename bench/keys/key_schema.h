#pragma once

#include <span>

#include "bench/keys/key_info.h"
#include "engine/document/node.h"
#include "io/files/json.h"

namespace etude {

/// Returns a value of a document as JSON. A document keeps values as text, so whatever reads as a number, true or false
/// becomes one, even in quotes.
Json ToJson(const Node& node);

/// Returns the JSON Schema (draft 7, the best supported by editors) of a key's value, with description and default.
Json KeySchema(const KeyInfo& key);

/// Returns the JSON Schema of a mapping with these keys and no others. A key may be listed several times with different
/// conditions.
Json MappingSchema(std::span<const KeyInfo> keys);

/// Writes a schema as text, one line a key; objects of described keys, and long lines, take several lines.
std::string SchemaText(const Json& schema, const std::string& indent = {});

/// Returns the conditions between keys and other keys' values, as `dependencies`. `says_all`: true = an absent key has
/// its default; false = another part of the file may contain it.
Json ConditionSchemas(std::span<const KeyInfo> keys, bool says_all);

}  // namespace etude
