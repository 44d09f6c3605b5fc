#include "bench/keys/key_schema.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/text.h"

namespace etude {
namespace {

Json ScalarToJson(const Node& node) {
  const std::string& text = node.scalar;
  if (text == "true" || text == "false") return text == "true";
  const auto number = AsNumber(node);
  if (!number) return text;
  if (const auto whole = ParseNumber<std::int64_t>(text)) return *whole;  // keeps 5 as 5, not 5.0
  return *number;
}

std::vector<KeyInfo> Variants(const std::string& name, std::span<const KeyInfo> keys) {
  std::vector<KeyInfo> variants;
  std::ranges::copy_if(keys, std::back_inserter(variants), [&](const KeyInfo& key) { return key.key == name; });
  return variants;
}

/// Returns a schema that accepts a value if one of `schemas` accepts it.
Json AnyOf(std::vector<Json> schemas) {
  if (schemas.size() == 1) return std::move(schemas.front());
  return {{"anyOf", std::move(schemas)}};
}

/// Returns the schema of a mapping that contains `key` and fulfils the key's condition. For `says_all`, see
/// ConditionSchemas.
Json ConditionSchema(const KeyInfo& key, std::span<const KeyInfo> keys, bool says_all) {
  const KeyCondition& condition = key.only_with;
  Json schema{
      {"properties", {{condition.key, {{"enum", condition.values}}}, {key.key, Json::parse(key.value.schema)}}}};
  const auto chooser = std::ranges::find(keys, condition.key, &KeyInfo::key);
  const bool by_default = chooser != keys.end() && std::ranges::count(condition.values, chooser->fallback) > 0;
  if (says_all && !by_default) schema["required"] = {condition.key};
  return schema;
}

/// Returns true if an item of `value`, at any depth, has a description. Such an item describes a key.
bool HoldsKeys(const Json& value) {
  return std::ranges::any_of(value, [](const Json& item) {
    return (item.is_object() && item.contains("description")) || (item.is_structured() && HoldsKeys(item));
  });
}

std::string Text(const Json& value, const std::string& indent, bool in_one_line) {
  if (!value.is_structured() || value.empty()) return value.dump();
  const std::string inner = indent + ' ';
  const std::string_view between = in_one_line ? ", " : ",\n";
  std::string text;
  for (const auto& [key, item] : value.items()) {
    text += text.empty() ? "" : between;
    if (!in_one_line) text += inner;
    if (value.is_object()) text += Json(key).dump() + ": ";
    text += in_one_line ? Text(item, inner, true) : SchemaText(item, inner);
  }
  if (!in_one_line) text = '\n' + text + '\n' + indent;
  return value.is_object() ? '{' + text + '}' : '[' + text + ']';
}

}  // namespace

std::string SchemaText(const Json& schema, const std::string& indent) {
  constexpr std::size_t kMaxLineLength = 600;
  if (schema.is_structured() && HoldsKeys(schema)) return Text(schema, indent, false);
  std::string line = Text(schema, indent, true);
  return schema.is_structured() && line.size() > kMaxLineLength ? Text(schema, indent, false) : line;
}

Json ToJson(const Node& node) {
  switch (node.kind) {
    case Node::Kind::kNull:
      return nullptr;
    case Node::Kind::kScalar:
      return ScalarToJson(node);
    case Node::Kind::kSequence: {
      Json list = Json::array();
      for (const Node& item : node.items) list.push_back(ToJson(item));
      return list;
    }
    case Node::Kind::kMapping:
      break;
  }
  Json object = Json::object();
  for (const Node::Entry& entry : node.entries) object[entry.key] = ToJson(entry.value);
  return object;
}

Json KeySchema(const KeyInfo& key) {
  Json schema = Json::parse(key.value.schema);
  std::string description = key.meaning;
  if (!schema.contains("enum") || !key.only_with.key.empty()) description += " Allowed: " + key.AllowedWhere() + ".";
  if (!key.IsRequired() && !key.HasDefaultValue()) description += " When left out: " + key.fallback + ".";
  schema["description"] = std::move(description);
  if (!key.HasDefaultValue()) return schema;
  if (const auto value = ParseYaml(key.fallback, "default")) schema["default"] = ToJson(*value);
  return schema;
}

Json MappingSchema(std::span<const KeyInfo> keys) {
  Json properties = Json::object(), required = Json::array();
  for (const KeyInfo& key : keys) {
    std::vector<Json> schemas;
    for (const KeyInfo& variant : Variants(key.key, keys)) schemas.push_back(KeySchema(variant));
    properties[key.key] = AnyOf(std::move(schemas));
    if (key.IsRequired()) required.push_back(key.key);
  }
  Json schema{{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = std::move(required);
  if (Json conditions = ConditionSchemas(keys, true); !conditions.empty()) {
    schema["dependencies"] = std::move(conditions);
  }
  return schema;
}

Json ConditionSchemas(std::span<const KeyInfo> keys, bool says_all) {
  Json dependencies = Json::object();
  for (const KeyInfo& key : keys) {
    if (key.only_with.key.empty()) continue;
    std::vector<Json> schemas;
    for (const KeyInfo& variant : Variants(key.key, keys)) schemas.push_back(ConditionSchema(variant, keys, says_all));
    dependencies[key.key] = AnyOf(std::move(schemas));
  }
  return dependencies;
}

}  // namespace etude
