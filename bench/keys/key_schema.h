#pragma once

#include <span>

#include "bench/keys/key_info.h"
#include "engine/document/node.h"
#include "io/files/json.h"

namespace etude {

/// Returns a value of a document as JSON. A document stores all values as text. A text that reads as a number, true or
/// false becomes a number or boolean, even if it was quoted.
Json ToJson(const Node& node);

/// Returns the JSON Schema of a key's value, with description and default. The schema follows draft 7 of JSON Schema,
/// the version that most editors support.
Json KeySchema(const KeyInfo& key);

/// Returns the JSON Schema of a mapping that may have these keys and no others. A key may be listed several times with
/// different conditions.
Json MappingSchema(std::span<const KeyInfo> keys);

/// Writes a schema as text with one line per key. An object whose keys have descriptions, and any line that would be
/// too long, is split over several lines.
std::string SchemaText(const Json& schema, const std::string& indent = {});

/// Returns the schema rules by which a key depends on the values of other keys, as `dependencies`. If `says_all` is
/// true, the mapping is complete, so an absent key has its default. If `says_all` is false, an absent key may be
/// in another part of the file.
Json ConditionSchemas(std::span<const KeyInfo> keys, bool says_all);

}  // namespace etude
