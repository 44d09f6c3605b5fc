#pragma once

#include <span>

#include "bench/keys/key_info.h"
#include "engine/document/node.h"
#include "io/files/json.h"

namespace etude {

/// Returns a value of a document as JSON. A document keeps values as text, so a text that reads as a number, true or
/// false becomes one, even if it had quotes.
Json ToJson(const Node& node);

/// Returns the JSON Schema (draft 7, the best supported by editors) of a key's value, with description and default.
Json KeySchema(const KeyInfo& key);

/// Returns the JSON Schema of a mapping with these keys and no others. A key may be listed several times with different
/// conditions.
Json MappingSchema(std::span<const KeyInfo> keys);

/// Writes a schema as text, one line for each key; objects with described keys, and long lines, take several lines.
std::string SchemaText(const Json& schema, const std::string& indent = {});

/// Returns the conditions between keys and other keys' values, as `dependencies`. `says_all`: true = an absent key has
/// its default; false = it may stand in another part of the file.
Json ConditionSchemas(std::span<const KeyInfo> keys, bool says_all);

}  // namespace etude
