#pragma once

#include <span>

#include "bench/keys/key_info.h"
#include "engine/document/node.h"
#include "io/files/json.h"

namespace etude {

/// A value of a document as JSON. A document keeps only the text of its values: what reads as a number, true or false
/// is one, even in quotes.
Json ToJson(const Node& node);

/// The JSON Schema (draft 7, which editors know best) of a key's value, with description and default.
Json KeySchema(const KeyInfo& key);

/// The JSON Schema of a mapping with these keys and no others. A key may stand there several times, with other
/// conditions each.
Json MappingSchema(std::span<const KeyInfo> keys);

/// A schema as text, a key a line: only what holds described keys, or would be a very long line, takes several.
std::string SchemaText(const Json& schema, const std::string& indent = {});

/// The conditions between keys and the values of others, as `dependencies`. `says_all`: an absent key has its default;
/// else another part of the file may say it.
Json ConditionSchemas(std::span<const KeyInfo> keys, bool says_all);

}  // namespace etude
