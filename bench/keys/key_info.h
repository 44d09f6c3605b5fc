#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/document/fields.h"

namespace etude {

struct KeyInfo;

/// The allowed values of a key, for people and as JSON Schema.
struct ValueKind {
  std::string allowed;  ///< "ccd, ccd-hinges", "0…180 (degrees)", "a list of texts"
  std::string schema;   ///< JSON
  /// Tells whether a non-empty value is the name of a file; if so, the key's reader receives the text of that file.
  /// Null: no value is a file name.
  bool (*names_file)(std::string_view value) = nullptr;
};
ValueKind NumberKind(Range range, bool is_whole = false);
ValueKind FlagKind();
/// Returns the kind of a text that matches the regular expression `pattern`; empty = any text.
ValueKind TextKind(std::string allowed, const std::string& pattern = "");
/// Returns the kind of a text that names a file. `names_file` distinguishes files from built-in names; null: there are
/// no built-in names.
ValueKind FileKind(std::string allowed, bool (*names_file)(std::string_view value) = nullptr);
/// Returns the kind of a value that is one of these texts.
ValueKind NameKind(std::span<const std::string> names);
/// The number of values that a list may have.
struct Count {
  std::size_t fewest = 0;
  std::size_t most = 0;
};
/// Returns the kind of a list of such values: `count` of them, or any number.
ValueKind ListKind(std::string allowed, const ValueKind& item, std::optional<Count> count = {});
/// Returns the kind of a mapping with these keys.
ValueKind MappingKind(std::string allowed, std::span<const KeyInfo> keys);

/// Allows a key only if another key of its mapping has one of these values.
struct KeyCondition {
  std::string key;                  ///< "solver"; empty: no condition
  std::vector<std::string> values;  ///< any of these
};

/// A key of a scenario file, with everything that its reference page, its complaints and its schema need.
struct KeyInfo {
  std::string key;
  ValueKind value;
  std::string fallback;  ///< the default as a file would state it, or its meaning in (parentheses); "" = the key is
                         ///< required
  std::string meaning;   ///< one sentence
  KeyCondition only_with = {};

  /// Returns the allowed values and the condition: "0…1; with `weights: adaptive`".
  std::string AllowedWhere() const;
  bool IsRequired() const { return fallback.empty(); }
  bool HasDefaultValue() const { return !fallback.empty() && fallback.front() != '('; }
};

/// Returns a number as pages and defaults show it: 1000000, 0.33, 1e-06.
std::string NumberText(double number);

/// Merges keys that differ in their conditions only.
std::vector<KeyInfo> MergeAlike(std::vector<KeyInfo> keys);

/// Returns true if the values of `mapping` allow `key` in it. `keys` are all keys that the mapping may have; absent
/// ones have their defaults. A key is not allowed if the key on which it depends is not.
bool MayStand(const KeyInfo& key, std::span<const KeyInfo> keys, const Node& mapping);

/// Complains of keys of `mapping` that do not fit its other values (KeyInfo::only_with), because they would have no
/// effect. Marks all `keys` as known.
void RefuseMisplacedKeys(Fields& mapping, std::span<const KeyInfo> keys);

}  // namespace etude
