#include "bench/keys/key_info.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/keys/key_schema.h"
#include "engine/base/names.h"
#include "io/files/json.h"

namespace etude {
namespace {

/// Returns the value of `key` in `mapping`, or the key's default if the mapping does not have the key.
std::string ValueOf(const std::string& key, std::span<const KeyInfo> keys, const Node& mapping) {
  const Node* value = mapping.Find(key);
  if (value != nullptr) return value->scalar;
  const auto chooser = std::ranges::find(keys, key, &KeyInfo::key);
  return chooser == keys.end() ? "" : chooser->fallback;
}

/// Returns the key on which `key` depends, if that other key is itself not allowed; else null.
const KeyInfo* MisplacedChooser(const KeyInfo& key, std::span<const KeyInfo> keys, const Node& mapping) {
  const auto chooser = std::ranges::find(keys, key.only_with.key, &KeyInfo::key);
  return chooser == keys.end() || MayStand(*chooser, keys, mapping) ? nullptr : &*chooser;
}

Json NumberSchema(Range range, bool is_whole) {
  Json schema{{"type", is_whole ? "integer" : "number"}};
  if (std::isfinite(range.lowest)) schema["minimum"] = Json::parse(NumberText(range.lowest));
  if (std::isfinite(range.highest)) schema["maximum"] = Json::parse(NumberText(range.highest));
  return schema;
}

}  // namespace

ValueKind NumberKind(Range range, bool is_whole) {
  const bool has_ends = std::isfinite(range.lowest) && std::isfinite(range.highest);
  return {has_ends ? fmt::format("{}…{}", NumberText(range.lowest), NumberText(range.highest)) : "a number",
          NumberSchema(range, is_whole).dump()};
}

ValueKind FlagKind() { return {"true, false", R"({"type":"boolean"})"}; }

ValueKind TextKind(std::string allowed, const std::string& pattern) {
  Json schema{{"type", {"string", "number"}}};  // text that looks like a number is allowed, too
  if (!pattern.empty()) schema["pattern"] = pattern;
  return {std::move(allowed), schema.dump()};
}

ValueKind FileKind(std::string allowed, bool (*names_file)(std::string_view value)) {
  ValueKind kind = TextKind(std::move(allowed));
  kind.names_file = names_file != nullptr ? names_file : [](std::string_view) { return true; };
  return kind;
}

ValueKind NameKind(std::span<const std::string> names) {
  return {Join(names), Json{{"enum", std::vector(names.begin(), names.end())}}.dump()};
}

ValueKind ListKind(std::string allowed, const ValueKind& item, std::optional<Count> count) {
  Json schema{{"type", "array"}, {"items", Json::parse(item.schema)}};
  if (count) schema.update({{"minItems", count->fewest}, {"maxItems", count->most}});
  return {std::move(allowed), schema.dump()};
}

ValueKind MappingKind(std::string allowed, std::span<const KeyInfo> keys) {
  return {std::move(allowed), MappingSchema(keys).dump()};
}

std::string KeyInfo::AllowedWhere() const {
  if (only_with.key.empty()) return value.allowed;
  return fmt::format("{}; with `{}: {}`", value.allowed, only_with.key, Join(only_with.values));
}

std::string NumberText(double number) {
  const bool is_whole = number == std::floor(number) && std::abs(number) < 1e16;
  return is_whole ? fmt::format("{:.0f}", number) : fmt::format("{:g}", number);
}

std::vector<KeyInfo> MergeAlike(std::vector<KeyInfo> keys) {
  std::vector<KeyInfo> merged;
  for (KeyInfo& key : keys) {
    const auto alike = std::ranges::find_if(merged, [&](const KeyInfo& other) {
      return other.key == key.key && other.value.allowed == key.value.allowed && other.fallback == key.fallback &&
             other.meaning == key.meaning && other.only_with.key == key.only_with.key;
    });
    if (alike == merged.end()) {
      merged.push_back(std::move(key));
    } else {
      std::vector<std::string>& values = alike->only_with.values;
      values.insert(values.end(), key.only_with.values.begin(), key.only_with.values.end());
    }
  }
  return merged;
}

bool MayStand(const KeyInfo& key, std::span<const KeyInfo> keys, const Node& mapping) {
  const KeyCondition& condition = key.only_with;
  if (condition.key.empty()) return true;
  const auto chooser = std::ranges::find(keys, condition.key, &KeyInfo::key);
  if (chooser != keys.end() && !MayStand(*chooser, keys, mapping)) return false;
  return std::ranges::count(condition.values, ValueOf(condition.key, keys, mapping)) > 0;
}

void RefuseMisplacedKeys(Fields& mapping, std::span<const KeyInfo> keys) {
  for (const KeyInfo& key : keys) {
    const Node* written = mapping.Raw(key.key);
    if (written == nullptr) continue;
    // The values with which a key of this name is allowed: values of the key that the condition names (the chooser).
    std::vector<std::string> allowed;
    const bool may_stand = std::ranges::any_of(keys, [&](const KeyInfo& other) {
      if (other.key != key.key) return false;
      allowed.insert(allowed.end(), other.only_with.values.begin(), other.only_with.values.end());
      return MayStand(other, keys, mapping.node());
    });
    if (may_stand) continue;
    const KeyInfo* misplaced = &key;
    while (const KeyInfo* chooser = MisplacedChooser(*misplaced, keys, mapping.node())) {
      misplaced = chooser;
      allowed = chooser->only_with.values;
    }
    const std::string& chooser = misplaced->only_with.key;
    mapping.Complain(written->place, fmt::format("{} '{}'{} has no key '{}'; this key is allowed with {}: {}", chooser,
                                                 ValueOf(chooser, keys, mapping.node()),
                                                 mapping.node().Find(chooser) == nullptr ? " (the default)" : "",
                                                 key.key, chooser, Join(allowed)));
  }
}

}  // namespace etude
