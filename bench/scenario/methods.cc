#include "bench/scenario/methods.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "bench/files/json.h"
#include "engine/base/names.h"

namespace etude {
namespace {

constexpr std::size_t kMostMethods = 100;
constexpr double kLongestTime_s = 86'400;

Json ScalarToJson(const Node& node) {
  const std::string& text = node.scalar;
  if (text == "true" || text == "false") return text == "true";
  const auto number = AsNumber(node);
  if (!number) return text;
  std::int64_t whole = 0;  // 5 stays 5 and does not become 5.0
  const char* end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, whole);
  if (status == std::errc() && stop == end) return whole;
  return *number;
}

/// A document keeps only the text of its values: what reads as a number, true or false is one, even in quotes.
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

std::string ReadOptions(Fields& method) {
  const Node* options = method.Raw("options");
  if (options == nullptr) return "{}";
  if (options->kind != Node::Kind::kMapping) {
    method.Complain(options->place, "'options' must be a mapping (key: value), found " + Describe(*options));
    return "{}";
  }
  const auto text = WriteJson(ToJson(*options));
  if (text) return *text;
  method.Complain(options->place, text.error().message);  // bytes that are no UTF-8
  return "{}";
}

void ReadOutside(Fields& method, MethodEntry& entry) {
  const Node* exec = method.Raw("exec");
  entry.exec = method.Texts("exec");
  if (entry.exec.empty() || entry.exec.front().empty()) {
    method.Complain(exec->place, "'exec' needs a program and its arguments, such as [python3, my_solver.py]");
  }
  entry.options_json = ReadOptions(method);
  entry.time_s = method.OptionalNumber("time_s", {0.001, kLongestTime_s});
}

/// The keys of a built-in method are its task's: it reads their values. Their names are checked here, where it is
/// known that `against` and `exec` may stand beside them.
void CheckKeysOfBuiltIn(Fields& method, const TaskKind& kind) {
  for (const char* key : {"options", "time_s"}) {
    const Node* value = method.Raw(key);
    if (value != nullptr) method.Complain(value->place, fmt::format("'{}' is for methods with 'exec'", key));
  }
  for (const KeyInfo& key : kind.method_keys) method.Raw(key.key);
}

Result<MethodEntry> ReadMethod(const Node& node, const TaskKind& kind) {
  const bool outside = node.Find("exec") != nullptr;
  Fields method(node, outside ? "a method with 'exec'" : "a method of task " + kind.name);
  MethodEntry entry;
  entry.name = ReadPlainName(method, "name");
  for (const char* key : {"against", "exec"}) method.Raw(key);
  if (outside) {
    ReadOutside(method, entry);
  } else {
    CheckKeysOfBuiltIn(method, kind);
  }
  RETURN_IF_ERROR(method.Finish());
  entry.node = node;
  std::erase_if(entry.node.entries, [](const Node::Entry& key) { return key.key == "against"; });
  return entry;
}

}  // namespace

bool IsPlainName(const std::string& name) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           c == '.';
  };
  return !name.empty() && name.size() <= 80 && name[0] != '.' && std::all_of(name.begin(), name.end(), plain);
}

std::string ReadPlainName(Fields& fields, std::string_view key) {
  std::string name = fields.RequiredText(key);
  if (fields.ok() && !IsPlainName(name)) {
    fields.Complain(fields.node().Find(key)->place,
                    fmt::format("'{}' is no {}; allowed: letters, digits, '-', '_' and '.', at most 80", name, key));
  }
  return name;
}

std::vector<MethodEntry> ReadMethods(Fields& fields, const TaskKind& kind) {
  std::vector<MethodEntry> methods;
  const auto complain = [&](const Error& error) {
    fields.Complain(error.place, error.message);
    return std::vector<MethodEntry>{};
  };
  const Node* list = fields.Raw("methods");
  if (list == nullptr || list->kind != Node::Kind::kSequence || list->items.empty()) {
    return complain({list == nullptr ? fields.node().place : list->place,
                     "a scenario needs 'methods', a list of at least one {name: …}"});
  }
  if (list->items.size() > kMostMethods) {
    return complain({list->place, fmt::format("{} methods; at most {}", list->items.size(), kMostMethods)});
  }
  std::vector<std::string> names;
  for (const Node& item : list->items) {
    auto method = ReadMethod(item, kind);
    if (!method) return complain(method.error());
    if (std::find(names.begin(), names.end(), method->name) != names.end()) {
      return complain({item.place, fmt::format("two methods are named '{}'", method->name)});
    }
    names.push_back(method->name);
    methods.push_back(*std::move(method));
  }
  for (std::size_t i = 0; i < methods.size(); ++i) {  // only now are all names known
    Fields method(list->items[i], "a method");
    methods[i].against = method.Choice("against", names, names.front());
    if (!method.ok()) return complain(method.Finish().error());
  }
  return methods;
}

}  // namespace etude
