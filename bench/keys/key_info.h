#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/document/fields.h"

namespace etude {

struct KeyInfo;

/// The kind of a key's value: the allowed values in words, and as JSON Schema.
struct ValueKind {
  std::string allowed;  ///< the allowed values in words, e.g. "ccd, ccd-hinges", "0…180 (degrees)", "a list of texts"
  std::string schema;   ///< the allowed values as JSON Schema
  /// Returns true if a non-empty value is the name of a file; the key's reader then receives the text of that file.
  /// Null: no value is a file name.
  bool (*names_file)(std::string_view value) = nullptr;
};
ValueKind NumberKind(Range range, bool is_whole = false);
ValueKind FlagKind();
/// Returns the kind of a text that matches the regular expression `pattern`; "" = any text.
ValueKind TextKind(std::string allowed, const std::string& pattern = "");
/// Returns the kind of a text that names a file. `names_file` returns false for built-in names; null = there are no
/// built-in names.
ValueKind FileKind(std::string allowed, bool (*names_file)(std::string_view value) = nullptr);
/// Returns the kind of a text that must be one of `names`.
ValueKind NameKind(std::span<const std::string> names);
/// The number of values that a list may have.
struct Count {
  std::size_t fewest = 0;
  std::size_t most = 0;
};
/// Returns the kind of a list of `item` values with `count` entries; without `count`, any number of entries.
ValueKind ListKind(std::string allowed, const ValueKind& item, std::optional<Count> count = {});
/// Returns the kind of a mapping that has these keys.
ValueKind MappingKind(std::string allowed, std::span<const KeyInfo> keys);

/// The condition under which a key is allowed: another key of its mapping has one of these values.
struct KeyCondition {
  std::string key;                  ///< the other key, e.g. "solver"; empty: no condition
  std::vector<std::string> values;  ///< the values of that key with which this key is allowed
};

/// A key of a scenario file, with everything that its reference page, error messages and schema need.
struct KeyInfo {
  std::string key;
  ValueKind value;
  std::string fallback;  ///< the default as a file would state it, or a description of it in (parentheses); "" =
                         ///< required
  std::string meaning;   ///< one sentence about the key
  KeyCondition only_with = {};

  /// Returns the allowed values and the condition, e.g. "0…1; with `weights: adaptive`".
  std::string AllowedWhere() const;
  bool IsRequired() const { return fallback.empty(); }
  bool HasDefaultValue() const { return !fallback.empty() && fallback.front() != '('; }
};

/// Returns a number as reference pages show it: 1000000, 0.33, 1e-06.
std::string NumberText(double number);

/// Merges keys that differ only in their conditions.
std::vector<KeyInfo> MergeAlike(std::vector<KeyInfo> keys);

/// Returns true if `mapping` may contain `key`: the key on which `key` depends is allowed itself and has one of the
/// values that allow `key`. `keys` are all keys that the mapping may have; an absent key has its default value.
bool MayStand(const KeyInfo& key, std::span<const KeyInfo> keys, const Node& mapping);

/// Adds an error for every key of `mapping` whose condition (KeyInfo::only_with) does not hold, because the key would
/// have no effect. Marks all `keys` as known.
void RefuseMisplacedKeys(Fields& mapping, std::span<const KeyInfo> keys);

}  // namespace etude
