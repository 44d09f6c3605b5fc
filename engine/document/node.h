#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// One value of a YAML document, and where it stands, so that every complaint can point at it.
struct Node {
  enum class Kind { kNull, kScalar, kSequence, kMapping };
  struct Entry;

  Kind kind = Kind::kNull;
  std::string scalar;          ///< kScalar: the text as written, quotes removed
  std::vector<Node> items;     ///< kSequence
  std::vector<Entry> entries;  ///< kMapping, in the order written; keys are unique
  Place place;

  /// The value under `key`, or null when this is no mapping or has no such key.
  const Node* Find(std::string_view key) const;
};

struct Node::Entry {
  std::string key;
  Place place;  ///< of the key
  Node value;
};

/// Reads one YAML document. `file` names it in complaints. Refused: syntax errors, duplicate keys,
/// aliases, a second document, more than `largest` bytes of text (1 MiB unless texts hold data) or 10,000 values,
/// nesting deeper than 32 levels.
Result<Node> ParseYaml(std::string_view text, const std::string& file, std::size_t largest = std::size_t{1} << 20);

/// Returns how many values a document or a part of it holds, itself among them.
std::size_t CountValues(const Node& node);

/// Describes a value as complaints do: "a mapping", "a list", "the text 'abc'", "nothing": how complaints name what was
/// found.
std::string Describe(const Node& node);

}  // namespace etude
