#include "bench/scenario/keys.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/keys/key_schema.h"
#include "bench/scenario/judging.h"
#include "bench/scenario/methods.h"
#include "bench/scenario/outside_metrics.h"
#include "bench/scenario/scenario.h"
#include "bench/scenario/sources.h"
#include "bench/scenario/sweep.h"
#include "bench/tasks/registry.h"
#include "engine/base/named.h"

namespace etude {
namespace {

/// Returns the keys of a sweep apart from the task's parameters.
std::vector<KeyInfo> SweepKeys() {
  return {{"together",
           {"a mapping of parameters to lists of equal length, or a list of such mappings", "{}"},
           "(none)",
           "Parameters that change together: the first values form one condition, the second values the next "
           "condition, and so on."}};
}

template <typename Keys>
KeyGroup Group(std::string path, std::string title, const Keys& keys) {
  return {std::move(path), std::move(title), {keys.begin(), keys.end()}};
}

std::string Cell(const std::string& text) {
  std::string cell;
  for (char c : text) cell += c == '|' ? std::string("\\|") : std::string(1, c);
  return cell;
}

}  // namespace

std::vector<KeyGroup> AllKeyGroups() {
  const Scenario any;
  std::vector<KeyGroup> groups = {
      Group("", "A file with several scenarios", FileKeys()),
      Group("scenarios[]", "A scenario of any task", CommonScenarioKeys()),
      Group("sweep", "A sweep: the key that is not a parameter of the task", SweepKeys()),
      Group("sweep.PARAMETER", "A range of values", RangeFields(kMaxConditions).Describe()),
      Group("methods[]", "A method", OutsideMethodFields().Describe()),
      Group("metrics[]", "A metric that your own program measures", OutsideMetricFields().Describe()),
      Group("metrics[].vectors[]", "A test vector", MetricExampleFields().Describe()),
      Group("expect[]", "An expectation", ExpectationFields(any, {}).Describe()),
      Group("video", "Recordings for films", VideoFields(any).Describe()),
      Group("limits", "Limits", LimitFields().Describe()),
      Group("success", "What success is", SuccessFields({}).Describe()),
      Group("gate", "The gate", GateFields(any, {}).Describe()),
      Group("gate.tail", "The gate's tail rule", TailFields().Describe()),
      Group("gate.time_ratios[]", "A ratio of times", TimeRatioFields(any).Describe())};
  for (const TaskKind& kind : AllTaskKinds()) {
    groups.push_back({"scenarios[]", "A scenario of task " + kind.name, kind.condition_keys});
    groups.push_back({"methods[]", "A method of task " + kind.name, kind.method_keys});
  }
  return groups;
}

std::string KeysAsMarkdown() {
  std::string page =
      "# Every key of a scenario file\n"
      "\nWritten by `etude list keys --markdown`; a test compares the two. [scenarios.md](../scenarios.md) explains "
      "how the keys work together.\n"
      "A default in (parentheses) describes what happens without the key. Every other default is a value that you "
      "could write.\n";
  for (const KeyGroup& group : AllKeyGroups()) {
    page += fmt::format("\n## {}{}\n\n| key | allowed | default | meaning |\n|---|---|---|---|\n", group.title,
                        group.path.empty() ? "" : fmt::format(": `{}`", group.path));
    for (const KeyInfo& key : group.keys) {
      page += fmt::format("| `{}` | {} | {} | {} |\n", key.key, Cell(key.AllowedWhere()),
                          key.IsRequired() ? "required" : Cell(key.fallback), Cell(key.meaning));
    }
  }
  return page;
}

namespace {

Json Ref(const std::string& definition) { return {{"$ref", "#/definitions/" + definition}}; }
Json ListOf(Json item) { return {{"type", "array"}, {"items", std::move(item)}}; }
/// Returns the schema that accepts an object in which `key` has this value.
Json Says(const std::string& key, const std::string& value) {
  return {{"properties", {{key, {{"const", value}}}}}, {"required", {key}}};
}
Json Has(const char* key) { return {{"required", {key}}}; }
Json If(Json condition, Json then) { return {{"if", std::move(condition)}, {"then", std::move(then)}}; }

/// Returns the schema of the allowed key names of a scenario: the keys that all scenarios have, the keys of files, and
/// `own`.
Json Names(std::span<const KeyInfo> own) {
  std::vector<std::string> names = NamesOf(CommonScenarioKeys(), &KeyInfo::key);
  for (const std::vector<std::string>& more : {NamesOf(FileKeys(), &KeyInfo::key), NamesOf(own, &KeyInfo::key)}) {
    names.insert(names.end(), more.begin(), more.end());
  }
  return {{"enum", names}};
}

/// Returns the schema of a task's sweep: each parameter with its values. Lists and mappings cannot be swept.
Json SweepSchema(const TaskKind& kind) {
  Json parameters = Json::object();
  for (const KeyInfo& key : kind.condition_keys) {
    const Json schema = Json::parse(key.value.schema);
    if (schema.value("type", Json()) == "array") continue;
    Json values = ListOf(Ref(kind.name + "/properties/" + key.key));
    values["minItems"] = 1;
    const bool is_name = schema.contains("enum") || schema.value("type", Json()) == "boolean";
    parameters[key.key] = is_name ? values : Json{{"anyOf", {values, Ref("range")}}};
  }
  const Json group{
      {"type", "object"}, {"minProperties", 2}, {"properties", parameters}, {"additionalProperties", false}};
  parameters["together"] = {{"anyOf", {group, ListOf(group)}}};
  return {{"type", "object"}, {"properties", std::move(parameters)}, {"additionalProperties", false}};
}

/// Returns the schema of a method. A method with `exec` is a program and has the keys of programs; a method without it
/// has the keys of its task. A program with a `seat` has both.
Json MethodSchema(const TaskKind& kind) {
  std::vector<KeyInfo> keys;
  for (const KeyInfo& common : OutsideMethodFields().Describe()) {
    const bool has_every_method = common.key == "name" || common.key == "against" || common.key == "description";
    if (!kind.seats.empty() || has_every_method) keys.push_back(common);
  }
  keys.insert(keys.end(), kind.method_keys.begin(), kind.method_keys.end());
  if (!kind.has_problems) return MappingSchema(keys);
  Json asked_whole = Has("exec");
  if (!kind.seats.empty()) asked_whole["not"] = Has("seat");
  return {{"if", std::move(asked_whole)}, {"then", Ref("outside-method")}, {"else", MappingSchema(keys)}};
}

/// Returns the schema of the keys that a scenario of this task has in addition to the common ones.
Json TaskSchema(const TaskKind& kind) {
  Json properties = Json::object();
  for (const KeyInfo& key : kind.condition_keys) properties[key.key] = KeySchema(key);
  const Json metric{{"enum", MetricsOf(kind)}}, metrics = {{"properties", {{"metrics", ListOf(metric)}}}};
  properties["sweep"] = SweepSchema(kind);
  properties["methods"] = ListOf(Ref(kind.name + "-method"));
  const Json own{{"properties", {{"metrics", {{"contains", {{"type", "object"}}}}}}}, {"required", {"metrics"}}};
  const Json ours{{"expect", ListOf({{"properties", {{"metric", metric}}}})}, {"gate", metrics}};
  properties["metrics"] = ListOf({{"anyOf", {metric, Ref("outside-metric")}}});
  return {{"description", kind.question},
          {"properties", std::move(properties)},
          {"if", own},  // expectations may name the scenario's own metrics
          {"else", {{"properties", ours}}},
          {"propertyNames", Names(kind.condition_keys)},
          {"dependencies", ConditionSchemas(kind.condition_keys, false)}};
}

/// Returns the schema of the common keys and, once the task is known, of the task's keys.
Json AnyScenarioSchema() {
  Json schema = MappingSchema(CommonScenarioKeys());
  schema.erase("required");              // required keys may be in `defaults` instead
  schema.erase("additionalProperties");  // tasks add keys of their own
  std::vector<KeyInfo> of_any_task;
  Json branches = Json::array();
  for (const TaskKind& kind : AllTaskKinds()) {
    branches.push_back(If(Says("task", kind.name), Ref(kind.name)));
    of_any_task.insert(of_any_task.end(), kind.condition_keys.begin(), kind.condition_keys.end());
  }
  std::vector<KeyInfo> distinct;
  for (const KeyInfo& key : of_any_task) {
    if (std::ranges::find(distinct, key.key, &KeyInfo::key) == distinct.end()) distinct.push_back(key);
  }
  branches.push_back({{"if", Has("task")}, {"else", {{"propertyNames", Names(distinct)}}}});
  schema["allOf"] = std::move(branches);
  return schema;
}

/// Returns the schema of a file, which contains one scenario or a list of scenarios. Required keys may come from
/// `defaults` or from an included file.
Json ScenarioSchema() {
  std::vector<std::string> required;
  for (const KeyInfo& key : CommonScenarioKeys()) {
    if (key.IsRequired()) required.push_back(key.key);
  }
  const Json has_defaults{{"anyOf", {Has("defaults"), Has("include")}}};
  // The schema of a scenario in a list. Such a scenario does not have the keys of a file.
  Json listed{{"allOf", {Ref("scenario"), Has("scenario")}}, {"properties", Json::object()}};
  Json tops = Json::array();
  for (const KeyInfo& key : FileKeys()) listed["properties"][key.key] = false;
  for (const TaskKind& kind : AllTaskKinds()) {  // for files whose `defaults` name the task of all scenarios
    Json in_list = ListOf({{"if", {{"not", Has("task")}}}, {"then", Ref(kind.name)}});
    tops.push_back(If({{"properties", {{"defaults", Says("task", kind.name)}}}, {"required", {"defaults"}}},
                      {{"properties", {{"scenarios", std::move(in_list)}}}}));
  }
  // A required key must be in every scenario if `defaults` lacks it and no file is included.
  for (const std::string& key : required) {
    const Json default_says{{"properties", {{"defaults", {{"required", {key}}}}}}, {"required", {"defaults"}}};
    tops.push_back({{"if", {{"anyOf", {default_says, Has("include")}}}},
                    {"else", {{"properties", {{"scenarios", ListOf({{"required", {key}}})}}}}}});
  }
  // The schema of a file with `scenarios`.
  Json of_list = MappingSchema(FileKeys());
  of_list["properties"]["scenarios"]["items"] = std::move(listed);
  of_list["properties"]["defaults"] = {{"allOf", {Ref("scenario")}}, {"properties", {{"scenario", false}}}};
  of_list["allOf"] = std::move(tops);
  Json only_defaults = of_list;  // for a file of defaults that other files include
  for (const char* key : {"required", "allOf"}) only_defaults.erase(key);
  only_defaults["properties"].erase("scenarios");
  // The schema of a file with a single scenario.
  Json single{{"allOf", {Ref("scenario"), {{"if", has_defaults}, {"else", {{"required", required}}}}, Has("scenario")}},
              {"properties", only_defaults["properties"]}};
  const Json is_included{{"not", {{"anyOf", {Has("scenario"), Has("question"), Has("task"), Has("methods")}}}},
                         {"anyOf", {Has("defaults"), Has("include")}}};
  return {{"type", "object"},
          {"if", Has("scenarios")},
          {"then", std::move(of_list)},
          {"else", {{"if", is_included}, {"then", std::move(only_defaults)}, {"else", std::move(single)}}}};
}

}  // namespace

std::string KeysAsSchema() {
  Json definitions{{"scenario", AnyScenarioSchema()},
                   {"outside-method", MappingSchema(OutsideMethodFields().Describe())},
                   {"outside-metric", MappingSchema(OutsideMetricFields().Describe())},
                   {"range", MappingSchema(RangeFields(kMaxConditions).Describe())}};
  for (const TaskKind& kind : AllTaskKinds()) {
    definitions[kind.name] = TaskSchema(kind);
    definitions[kind.name + "-method"] = MethodSchema(kind);
  }
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"},
              {"title", "A scenario file of Etude"},
              {"description",
               "Written by `etude list keys --schema`. A file that this schema accepts may still contain errors, "
               "because the program also checks which methods, conditions and files exist."}};
  schema.update(ScenarioSchema());
  schema["definitions"] = std::move(definitions);
  return SchemaText(schema) + "\n";
}

}  // namespace etude
