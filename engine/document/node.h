#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// One value of a YAML document and its position, so that every error message can refer to it.
struct Node {
  enum class Kind { kNull, kScalar, kSequence, kMapping };
  struct Entry;

  Kind kind = Kind::kNull;
  std::string scalar;          ///< kScalar: the text without quotes
  std::vector<Node> items;     ///< kSequence: the elements, in order
  std::vector<Entry> entries;  ///< kMapping: the entries, in the order of the document; keys are unique
  Place place;

  /// Returns the value of `key`, or null if this is not a mapping or has no such key.
  const Node* Find(std::string_view key) const;
};

struct Node::Entry {
  std::string key;
  Place place;  ///< position of the key
  Node value;
};

/// Parses one YAML document. `file` is its name in error messages. Refuses syntax errors, duplicate keys, aliases, a
/// second document, more than `max_bytes` bytes (by default 1 MiB; documents that hold data need more), more than
/// 10,000 values and nesting deeper than 32 levels.
Result<Node> ParseYaml(std::string_view text, const std::string& file, std::size_t max_bytes = std::size_t{1} << 20);

/// Returns the number of values in a document or in a part of a document, including `node` itself.
std::size_t CountValues(const Node& node);

/// Describes a value for error messages: "a mapping", "a list", "'abc'", "nothing".
std::string Describe(const Node& node);

}  // namespace etude
