#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/document/fields.h"

namespace etude {

struct KeyInfo;

/// The values that a key may have, for people and as JSON Schema.
struct ValueKind {
  std::string allowed;  ///< "ccd, ccd-hinges", "0…180 (degrees)", "a list of texts"
  std::string schema;   ///< JSON
  /// Tells whether a value that is not empty names a file, whose text the key's reader is given. Null: no value does.
  bool (*names_file)(std::string_view value) = nullptr;
};
ValueKind NumberKind(Range range, bool is_whole = false);
ValueKind FlagKind();
/// A text; `pattern` is a regular expression, empty = any.
ValueKind TextKind(std::string allowed, const std::string& pattern = "");
/// A text that names a file; `names_file` tells names of something built in from files, null: there are none.
ValueKind FileKind(std::string allowed, bool (*names_file)(std::string_view value) = nullptr);
/// One of these texts.
ValueKind NameKind(std::span<const std::string> names);
/// The number of values that a list may have.
struct Count {
  std::size_t fewest = 0;
  std::size_t most = 0;
};
/// A list of such values; `count` of them, or any number.
ValueKind ListKind(std::string allowed, const ValueKind& item, std::optional<Count> count = {});
/// A mapping with these keys.
ValueKind MappingKind(std::string allowed, std::span<const KeyInfo> keys);

/// The values of another key of the same mapping with which a key is allowed.
struct KeyCondition {
  std::string key;                  ///< "solver"; empty: no condition
  std::vector<std::string> values;  ///< any of these
};

/// A key of a scenario file: all that its page, its complaints and its schema say of it.
struct KeyInfo {
  std::string key;
  ValueKind value;
  std::string
      fallback;         ///< what an absent key means, as one would write it, or in (parentheses); "" = it must be there
  std::string meaning;  ///< one sentence
  KeyCondition only_with = {};

  /// The allowed values and the condition: "0…1; with `weights: adaptive`".
  std::string AllowedWhere() const;
  bool IsRequired() const { return fallback.empty(); }
  bool HasDefaultValue() const { return !fallback.empty() && fallback.front() != '('; }
};

/// A number as pages and defaults show it: 1000000, 0.33, 1e-06.
std::string NumberText(double number);

/// Keys that differ in their conditions only, as one.
std::vector<KeyInfo> MergeAlike(std::vector<KeyInfo> keys);

/// True when the values of `mapping` allow `key` in it; `keys` are all that it may have, and their defaults count as
/// said. A key may not stand where the one that decides about it may not.
bool MayStand(const KeyInfo& key, std::span<const KeyInfo> keys, const Node& mapping);

/// Complains of keys that `mapping` has and that do not go with its other values (KeyInfo::only_with): there they would
/// mean nothing, which is a mistake worth telling. Marks all `keys` as known.
void RefuseMisplacedKeys(Fields& mapping, std::span<const KeyInfo> keys);

}  // namespace etude
