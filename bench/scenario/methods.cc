#include "bench/scenario/methods.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/keys/key_schema.h"
#include "engine/base/text.h"
#include "io/files/json.h"

namespace etude {
namespace {

constexpr std::size_t kMaxMethods = 100;
constexpr double kMaxTime_s = 86'400;
/// The keys about a program. No task reads them.
constexpr std::string_view kProgramKeys[] = {"exec", "options", "files", "time_s"};

std::string ReadOptions(Fields& method) {
  const Node* options = method.Raw("options");
  if (options == nullptr) return "{}";
  if (options->kind != Node::Kind::kMapping) {
    method.Complain(options->place, "'options' must be a mapping (key: value), found " + Describe(*options));
    return "{}";
  }
  const auto text = WriteJson(ToJson(*options));
  if (text) return *text;
  method.Complain(options->place, text.error().message);  // the options contain, for example, bytes that are not UTF-8
  return "{}";
}

void ReadProgram(Fields& method, MethodEntry& entry) {
  entry.exec = method.Texts("exec");
  const Node* node = method.Raw("exec");
  if (node == nullptr) return;
  for (const Node& word : node->items) entry.exec_places.push_back(word.place);
  if (!entry.exec.empty() && !entry.exec.front().empty()) return;
  method.Complain(node->place, "'exec' must be a list of a program and its arguments, such as [python3, my_solver.py]");
}

/// Checks the key names of a built-in method. The method's task reads the values, but does not know that `against` and
/// `exec` are also allowed.
void CheckKeysOfBuiltIn(Fields& method, const TaskKind& kind) {
  for (const char* key : {"options", "files", "time_s"}) {
    const Node* value = method.Raw(key);
    if (value != nullptr)
      method.Complain(value->place, fmt::format("'{}' is allowed only for methods with 'exec'", key));
  }
  for (const KeyInfo& key : kind.method_keys) method.Raw(key.key);
}

Result<MethodEntry> ReadBuiltIn(const Node& node, const TaskKind& kind) {
  Fields method(node, "a method of task " + kind.name);
  MethodEntry entry;
  entry.name = ReadPlainName(method, "name");
  for (const char* key : {"against", "exec", "description"}) method.Raw(key);
  CheckKeysOfBuiltIn(method, kind);
  RETURN_IF_ERROR(method.Finish());
  return entry;
}

/// Reads a method that is a program in a seat (a part of the task's loop that a program replaces). The mapping of the
/// method also has keys of the task; the task reads their values.
Result<MethodEntry> ReadSeated(const Node& node, const TaskKind& kind) {
  Fields method(node, "a method of task " + kind.name + " with 'exec'");
  MethodEntry entry;
  OutsideMethodFields().ReadKeys(method, entry);
  if (kind.seats.empty()) {
    return Fail(node.Find("exec")->place, "'exec' is not allowed in task {}, because this task runs no programs",
                kind.name);
  }
  entry.seat = method.Choice("seat", kind.seats, "");
  if (entry.seat.empty() && method.ok()) {
    method.Complain(node.place, fmt::format("in task {}, a method with 'exec' needs the key 'seat'; allowed: {}",
                                            kind.name, fmt::join(kind.seats, ", ")));
  }
  for (const KeyInfo& key : kind.method_keys) method.Raw(key.key);
  RETURN_IF_ERROR(method.Finish());
  return entry;
}

bool IsSeated(const Node& node, const TaskKind& kind) {
  return !kind.has_problems || (!kind.seats.empty() && node.Find("seat") != nullptr);
}

Result<MethodEntry> ReadMethod(const Node& node, const TaskKind& kind) {
  auto entry = node.Find("exec") == nullptr ? ReadBuiltIn(node, kind)
               : IsSeated(node, kind)       ? ReadSeated(node, kind)
                                            : ReadMapping(node, "a method with 'exec'", OutsideMethodFields());
  if (!entry) return entry;
  if (entry->exec.empty() && node.Find("seat") != nullptr) {
    return Fail(node.Find("seat")->place, "'seat' is allowed only for methods with 'exec'");
  }
  // The task must not see the keys that are read here.
  entry->node = node;
  std::erase_if(entry->node.entries, [&](const Node::Entry& key) {
    const bool is_outside = std::ranges::find(kProgramKeys, key.key) != std::end(kProgramKeys);
    return key.key == "against" || key.key == "description" || (!entry->seat.empty() && is_outside);
  });
  return entry;
}

}  // namespace

bool IsPlainName(const std::string& name) {
  const auto plain = [](char c) { return IsLower(c) || IsUpper(c) || IsDigit(c) || c == '-' || c == '_' || c == '.'; };
  return !name.empty() && name.size() <= 80 && name[0] != '.' && name[0] != '-' &&
         std::all_of(name.begin(), name.end(), plain);
}

ValueKind PlainNameKind() {
  return TextKind("at most 80 letters, digits, '-', '_', '.'", "^[A-Za-z0-9_][A-Za-z0-9._-]{0,79}$");
}

const FieldTable<MethodEntry>& OutsideMethodFields() {
  using Key = Field<MethodEntry>;
  static const FieldTable<MethodEntry> table{
      {{{"name", PlainNameKind(), "", "The method's name. Names must be unique in the scenario."},
        [](Fields& method, MethodEntry& entry) { entry.name = ReadPlainName(method, "name"); }},
       {{"against", TextKind("a method"), "(the first method)", "The method with which this method is compared."},
        [](Fields&, MethodEntry&) {}},  // read once all names are known
       {{"description", TextKind("a sentence"), "(its settings)",
         "Describes the method for readers of the results. It does not change the results."},
        [](Fields&, MethodEntry&) {}},  // read for all methods in ReadMethods
       {{"exec",
         {"a list: a program and its arguments",
          R"({"type":"array","minItems":1,"items":{"type":["string","number"],"minLength":1}})"},
         "(the method is built in)",
         "The program that answers the problems. A method with `exec` has keys of its task only if it also has a "
         "`seat`."},
        ReadProgram},
       {{"options",
         {"a mapping; with `exec`", R"({"type":"object"})"},
         "{}",
         "Options that the program receives as JSON."},
        [](Fields& method, MethodEntry& entry) { entry.options_json = ReadOptions(method); }},
       Key::Texts(
           "files", &MethodEntry::files, "a list of folders and files; with `exec`",
           "Folders and files that the program can read inside its fence. By default, it can read its own folder."),
       Key::Number("time_s", &MethodEntry::time_s, {0.001, kMaxTime_s},
                   "Time limit for one problem or one step, in seconds.")
           .WhenAbsent("(`limits.time_s`)")
           .And("with `exec`")}};
  return table;
}

std::string ReadPlainName(Fields& fields, std::string_view key) {
  std::string name = fields.RequiredText(key);
  if (fields.ok() && !IsPlainName(name)) {
    fields.Complain(
        fields.node().Find(key)->place,
        fmt::format(
            "'{}' is not a valid {}; allowed: letters, digits, '_' and, after the first, '-' and '.'; at most 80", name,
            key));
  }
  return name;
}

std::vector<MethodEntry> ReadMethods(Fields& fields, const TaskKind& kind) {
  std::vector<MethodEntry> methods;
  const auto complain = [&](const Error& error) {
    fields.Complain(error.place, error.message);
    return std::vector<MethodEntry>{};
  };
  // Require a list of at least one method.
  const Node* list = fields.Raw("methods");
  if (list == nullptr || list->kind != Node::Kind::kSequence || list->items.empty()) {
    return complain({list == nullptr ? fields.node().place : list->place,
                     "a scenario needs 'methods', a list of at least one {name: …}"});
  }
  if (list->items.size() > kMaxMethods) {
    return complain(
        {list->place, fmt::format("found {} methods; allowed: at most {}", list->items.size(), kMaxMethods)});
  }
  // Read every method, and check that names are unique.
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
  for (std::size_t i = 0; i < methods.size(); ++i) {  // `against` needs all names
    Fields method(list->items[i], "a method");
    methods[i].against = method.Choice("against", names, names.front());
    methods[i].description = method.Text("description", "");
    if (!method.ok()) return complain(method.Finish().error());
  }
  return methods;
}

}  // namespace etude
