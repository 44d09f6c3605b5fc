#include "bench/scenario/scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/scenario/judging.h"
#include "bench/scenario/methods.h"
#include "bench/scenario/outside_metrics.h"
#include "bench/scenario/sources.h"
#include "bench/scenario/sweep.h"
#include "bench/tasks/registry.h"
#include "engine/base/named.h"
#include "engine/base/names.h"
#include "io/files/files.h"

namespace etude {
namespace {

constexpr Range kTrials{0, 1'000'000};
constexpr Range kBodies{0, 1000};
constexpr double kMaxSeed = 9007199254740992;  // 2^53: every integer up to it is exact in a double

void ReadFilmedTrials(Fields& video, const Scenario& scenario, RecordingSelection& selection) {
  const Node* trials = video.Raw("trials");
  std::vector<int> read;
  for (double trial : video.Numbers("trials", {0, scenario.trials - 1.0})) {
    if (trial != std::floor(trial)) video.Complain(trials->place, "'trials' must be a list of whole numbers");
    read.push_back(static_cast<int>(trial));
  }
  if (!read.empty()) selection.trials = std::move(read);
}

void ReadFilmedMethods(Fields& video, const Scenario& scenario, RecordingSelection& selection) {
  const std::vector<std::string> names = MethodNames(scenario), read = video.Texts("compare");
  for (std::size_t i = 0; i < read.size(); ++i) {
    if (std::find(names.begin(), names.end(), read[i]) != names.end()) continue;
    video.Complain(video.Raw("compare")->items[i].place, UnknownName("method", read[i], names));
  }
  selection.methods = read.empty() ? names : read;
}

std::vector<NamedClips> ReadLibraries(Fields& fields, const TaskKind& kind) {
  const Node* libraries = fields.Raw("libraries");
  if (libraries == nullptr) return {};
  if (!kind.uses_clips) fields.Complain(libraries->place, "'libraries' is not allowed in task " + kind.name);
  if (fields.Raw("clips") != nullptr)
    fields.Complain(libraries->place, "'libraries' replaces 'clips'; leave out one of them");
  if (libraries->kind != Node::Kind::kMapping || libraries->entries.empty()) {
    fields.Complain(libraries->place, "'libraries' must map names to lists of clips, found " + Describe(*libraries));
    return {};
  }
  std::vector<NamedClips> read;
  for (const Node::Entry& entry : libraries->entries) {
    const auto clips = AsTexts(entry.value);
    if (!IsPlainName(entry.key))
      fields.Complain(entry.place, "'" + entry.key +
                                       "' is not a valid library name; allowed: letters, digits, '_' and, after the "
                                       "first, '-' and '.'; at most 80");
    if (!clips) fields.Complain(clips.error().place, clips.error().message);
    read.push_back({entry.key, clips.value_or(std::vector<std::string>{})});
  }
  return read;
}

/// Returns the value of `key`; null if the key is absent or its value is an empty list or mapping. `streams: []`, for
/// example, means the same as no `streams`.
const Node* FindFilled(Fields& fields, const char* key) {
  const Node* node = fields.Raw(key);
  const bool is_empty =
      node != nullptr && node->kind != Node::Kind::kScalar && node->items.empty() && node->entries.empty();
  return is_empty ? nullptr : node;
}

/// Adds an error for recordings and labels in a scenario that cannot use them.
void CheckStreams(Fields& fields, const Scenario& scenario, const TaskKind& kind) {
  for (const char* key : {"streams", "labels", "reading"}) {
    const Node* named = FindFilled(fields, key);
    if (named == nullptr) continue;
    if (!kind.uses_recordings)
      fields.Complain(named->place, fmt::format("'{}' is not allowed in task {}", key, kind.name));
    if (!scenario.libraries.empty())
      fields.Complain(named->place, fmt::format("'{}' is not allowed together with 'libraries'", key));
  }
  const Node* streams = FindFilled(fields, "streams");
  if (streams != nullptr && FindFilled(fields, "clips") != nullptr) {
    fields.Complain(streams->place, "'streams' replaces 'clips'; leave out one of them");
  }
}

SamplingUnit ReadUnit(Fields& fields, const TaskKind& kind) {
  std::vector<std::string> names;
  for (SamplingUnit unit : kind.units) names.emplace_back(SamplingUnitName(unit));
  return ValueNamed(kSamplingUnits, fields.Choice("unit", names, names.front()));
}

}  // namespace

const FieldTable<StreamSource>& ReadingFields() {
  using Key = Field<StreamSource>;
  NamedValues<std::optional<StreamFormat>> formats;
  for (const std::string& name : StreamFormatNames()) formats.emplace_back(name, FindStreamFormat(name));
  static const FieldTable<StreamSource> table{
      {Key::Name("format", Path(&StreamSource::reading, &StreamReading::format), formats, "Format of the files.")
           .WhenAbsent("(detected from the content)"),
       Key::Number("rate_hz", Path(&StreamSource::reading, &StreamReading::rate_hz), {1, 1000},
                   "Frame rate of files without a clock, in Hz.")
           .WhenAbsent("30"),
       {{"body", NumberKind(kBodies, true), "(the body that is seen longest)",
         "If a recording shows several bodies, the body that Etude reads. Bodies are counted from 0, in the order of "
         "appearance."},
        [](Fields& fields, StreamSource& s) {
          if (const auto body = fields.OptionalWhole("body", kBodies)) s.reading.body = static_cast<int>(*body);
        }},
       Key::Flag("levels", Path(&StreamSource::making, &StreamOptions::levels),
                 "true: estimate the up axis and the floor; false: use the up axis and the floor of the file."),
       Key::Flag("reflects", Path(&StreamSource::making, &StreamOptions::reflects),
                 "true: negate X, because the recording is mirrored.")}};
  return table;
}

const FieldTable<Limits>& LimitFields() {
  using Key = Field<Limits>;
  static const FieldTable<Limits> table{
      {Key::Number("time_s", &Limits::time_s, {0.001, 86'400},
                   "Limit of processor time for building a world, and for each method, in seconds. For an outside "
                   "program, this is a limit of wall-clock time."),
       Key::Number("memory_mb", &Limits::memory_mb, {16, 1'048'576},
                   "Limit of resident memory for the worker, and for each program that the worker started.")}};
  return table;
}

FieldTable<RecordingSelection> VideoFields(const Scenario& scenario) {
  using Selection = RecordingSelection;
  return {
      {{{"compare", ListKind("a list of methods", TextKind("")), "(all)", "The methods whose motions the run keeps."},
        [&](Fields& video, Selection& selection) { ReadFilmedMethods(video, scenario, selection); }},
       {{"trials", ListKind("a list of whole numbers below `trials`", NumberKind({0, kTrials.highest}, true)), "[0]",
         "The trials whose motions the run keeps."},
        [&](Fields& video, Selection& selection) { ReadFilmedTrials(video, scenario, selection); }}}};
}

/// Returns the keys of every scenario, in the order of reading. A key is read only if the keys before it are valid,
/// because methods depend on the task, and expectations on the methods.
const FieldTable<Scenario>& ScenarioFields() {
  using Key = Field<Scenario>;
  static const auto when_right = [](auto read) {
    return [=](Fields& fields, Scenario& scenario) {
      if (fields.ok()) read(fields, scenario, *FindTaskKind(scenario.task));
    };
  };
  static const Scenario unread;
  static const FieldTable<Scenario> table{
      // The scenario's name, question and task.
      {{{"scenario", PlainNameKind(), "", "The scenario's name. Names must be unique in a run."},
        [](Fields& fields, Scenario& s) { s.name = ReadPlainName(fields, "scenario"); }},
       {{"question", TextKind("a text"), "", "The question that the scenario answers, in one sentence."},
        [](Fields& fields, Scenario& s) { s.question = fields.RequiredText("question"); }},
       Key::Text("description", &Scenario::description, "a sentence",
                 "Describes the worlds for readers of the results. It does not change the results.")
           .WhenAbsent("(none)"),
       {{"task", NameKind(NamesOf(AllTaskKinds())), "", "The task that the methods solve."},
        [](Fields& fields, Scenario& s) { s.task = fields.Choice("task", NamesOf(AllTaskKinds()), ""); }},
       // The motions from which the worlds are made.
       Key::Texts("clips", &Scenario::clips, "a list of `builtin:NAME`, `builtin:*`, motion files and patterns",
                  "The clips from which worlds are made. Trial after trial uses the next clip of the list."),
       Key::Texts("streams", Path(&Scenario::streams, &StreamSource::files),
                  "a list of files with recorded skeletons, patterns and folders (docs/streams.md)",
                  "Recordings that are used instead of `clips` and simulated people. Each recording is one trial. "
                  "`etude run --streams` replaces this list."),
       Key::Text("labels", Path(&Scenario::streams, &StreamSource::labels), "a file, or a folder of tag streams",
                 "Labels that state who performs which move at which time in `streams` or in `clips`. Labelled people "
                 "of `clips` replace simulated people.")
           .WhenAbsent("(each recording is one performance of the move that the file is named after)"),
       {{"reading", MappingKind("a mapping", ReadingFields().Describe()), "{}",
         "How Etude reads the files of `streams`."},
        [](Fields& fields, Scenario& s) { ReadNested(fields, "reading", ReadingFields(), s.streams); }},
       Key::Text("joint_map", &Scenario::joint_map, "a file",
                 "Assigns the clips' joints to roles. It is needed if the joints' names do not determine the roles.")
           .WhenAbsent("(roles by the joints' names)"),
       // The worlds and the conditions.
       Key::Number("trials", &Scenario::trials, {1, kTrials.highest}, "Number of worlds per condition."),
       Key::Number("seed", &Scenario::seed, {0, kMaxSeed}, "Seed of all worlds; `etude run --seed` overrides it.")
           .WhenAbsent("1"),
       {{"unit", NameKind(NamesOf(kSamplingUnits)), "(the task's)",
         "The unit from which worlds are drawn (clip, person or library). A verdict that is meant for other worlds "
         "counts each unit once."},
        when_right([](Fields& fields, Scenario& s, const TaskKind& kind) { s.unit = ReadUnit(fields, kind); })},
       {{"sweep",
         {"a mapping from parameters of the task to lists or ranges of values", R"({"type":"object"})"},
         "{}",
         "The values of swept parameters. The run has one condition for every combination of values."},
        when_right([](Fields& fields, Scenario& s, const TaskKind& kind) { s.conditions = ReadSweep(fields, kind); })},
       {{"libraries",
         {"a mapping from names to lists like `clips`", R"({"type":"object"})"},
         "(none)",
         "Libraries that are used instead of `clips`. Every condition runs once for each library, with the clips of "
         "this library only. `etude run --library` adds libraries."},
        when_right([](Fields& fields, Scenario& s, const TaskKind& kind) {
          AddLibraries(ReadLibraries(fields, kind), s);
          CheckStreams(fields, s, kind);
        })},
       // The methods, and the way in which they are compared.
       {{"methods",
         {"a list of 1…100 methods", R"({"type":"array","minItems":1,"maxItems":100})"},
         "",
         "The methods that the run compares in the same worlds."},
        when_right([](Fields& fields, Scenario& s, const TaskKind& kind) { s.methods = ReadMethods(fields, kind); })},
       {{"across", ListKind("a list of swept parameters", TextKind("")), "[]",
         "Swept parameters that are assumptions of the simulation. A verdict counts only if it is the same under all "
         "values of these parameters."},
        when_right([](Fields& fields, Scenario& s, const TaskKind&) {
          std::vector<std::string> swept;
          for (const SweptValue& value : s.conditions.front().swept) swept.push_back(value.key);
          const Node* across = fields.Raw("across");
          if (across != nullptr && !across->items.empty() && swept.empty()) {
            fields.Complain(across->place, "'across' names swept parameters, but this scenario has no sweep");
          }
          s.across = ReadNames(fields, "across", swept);
        })},
       {{"rival", TextKind("a method"), "(the run finds the best method)",
         "The strongest method. The run compares every other method with its baseline and, in addition, with this "
         "method."},
        when_right([](Fields& fields, Scenario& s, const TaskKind&) {
          s.rival = fields.Choice("rival", MethodNames(s), "");
        })},
       {{"metrics", HeadlineKind(), "(the task's)",
         "The headline metrics, the most important first. A mapping defines your own metric. If the list contains only "
         "your own metrics, the task's metrics come before them."},
        when_right([](Fields& fields, Scenario& s, const TaskKind& kind) {
          s.metrics = ReadHeadline(fields, kind, s.outside_metrics);
        })},
       {{"success", MappingKind("a mapping", SuccessFields({}).Describe()), "{}",
         "Defines the success of a cell. The scenario's answer compares the success of the methods first, and then the "
         "first other headline metric."},
        when_right([](Fields& fields, Scenario& s, const TaskKind& kind) {
          s.success = kind.success;
          s.success_matters = kind.success_matters;
          ReadNested(fields, "success", SuccessFields(SuccessMetricsOf(kind, s)), s);
        })},
       {{"expect", ListKind("a list of expectations", MappingKind("", ExpectationFields(unread, {}).Describe())), "[]",
         "The results that you expect. Etude checks them after the run."},
        when_right([](Fields& fields, Scenario& s, const TaskKind& kind) {
          s.expectations = ReadListed(fields, "expect", "an expectation", ExpectationFields(s, MetricsOf(kind, s)));
        })},
       // The data that a run keeps, its limits, and the rules of the gate.
       {{"video", MappingKind("a mapping", VideoFields(unread).Describe()), "(the run keeps no motion)",
         "The motions that the run keeps for the films of its report."},
        when_right([](Fields& fields, Scenario& s, const TaskKind&) {
          RecordingSelection selection{MethodNames(s), {0}};
          ReadNested(fields, "video", VideoFields(s), selection);
          if (fields.Raw("video") != nullptr) s.recordings = selection;
        })},
       {{"limits", MappingKind("a mapping", LimitFields().Describe()), "{}",
         "Limits of time and memory for a cell and for building a world. Etude stops a cell or a world that exceeds a "
         "limit."},
        [](Fields& fields, Scenario& s) { ReadNested(fields, "limits", LimitFields(), s.limits); }},
       {{"gate", MappingKind("a mapping", GateFields(unread, {}).Describe()), "{}",
         "The rules by which `etude gate` compares the run with a baseline."},
        when_right([](Fields& fields, Scenario& s, const TaskKind& kind) {
          s.gate.metrics = s.metrics;
          const bool is_named = s.success.empty() || std::ranges::find(s.metrics, s.success) != s.metrics.end();
          if (!is_named) s.gate.metrics.insert(s.gate.metrics.begin(), s.success);
          ReadNested(fields, "gate", GateFields(s, MetricsOf(kind, s)), s.gate);
        })}}};
  return table;
}

std::span<const KeyInfo> CommonScenarioKeys() {
  static const std::vector<KeyInfo> keys = ScenarioFields().Describe();
  return keys;
}

void AddLibraries(std::span<const NamedClips> libraries, Scenario& scenario) {
  std::vector<Condition> once;  // each condition once: the conditions of the first library, without its name
  for (Condition condition : scenario.conditions) {
    if (condition.library != scenario.conditions.front().library) continue;
    if (!condition.library.empty()) condition.swept.erase(condition.swept.begin());
    once.push_back(std::move(condition));
  }
  for (const NamedClips& library : libraries) {
    if (std::ranges::find(scenario.libraries, library.name, &NamedClips::name) != scenario.libraries.end()) continue;
    if (scenario.libraries.empty()) scenario.conditions.clear();
    scenario.libraries.push_back(library);
    for (Condition condition : once) {
      condition.library = library.name;
      condition.swept.insert(condition.swept.begin(), {"library", library.name});
      scenario.conditions.push_back(std::move(condition));
    }
  }
}

std::vector<NamedFile> FilesNamedBy(const Condition& condition, const TaskKind& kind) {
  std::vector<NamedFile> named;
  for (const KeyInfo& key : kind.condition_keys) {
    const Node* node = key.value.names_file == nullptr ? nullptr : condition.node.Find(key.key);
    if (node == nullptr || node->kind != Node::Kind::kScalar || node->scalar.empty()) continue;
    if (key.value.names_file(node->scalar)) named.push_back({key.key, node});
  }
  return named;
}

bool RecordingSelection::KeepsTrial(int trial) const {
  return std::find(trials.begin(), trials.end(), trial) != trials.end();
}

bool RecordingSelection::KeepsMethod(std::string_view name) const {
  return std::find(methods.begin(), methods.end(), name) != methods.end();
}

std::vector<std::string> MethodNames(const Scenario& scenario) { return NamesOf(scenario.methods); }

std::vector<ScenarioProgram> ProgramsIn(const Scenario& scenario) {
  std::vector<ScenarioProgram> programs;
  for (const MethodEntry& method : scenario.methods) {
    if (!method.exec.empty()) programs.push_back({&method});
  }
  for (const OutsideMetric& metric : scenario.outside_metrics) programs.push_back({&metric.program, "metric"});
  return programs;
}

namespace {

Result<Scenario> ParseScenario(const Node& node, const std::string& file) {
  Fields fields(node, "a scenario");
  Scenario scenario;
  scenario.file = file;
  ScenarioFields().Read(fields, scenario);
  if (const TaskKind* kind = FindTaskKind(scenario.task)) {
    // Mark the task's keys as known. The task reads their values.
    for (const KeyInfo& key : kind->condition_keys) fields.Raw(key.key);
  }
  RETURN_IF_ERROR(fields.Finish());
  return scenario;
}

Result<std::vector<Scenario>> ParseAll(const std::string& file, const TextOf& text_of) {
  ASSIGN_OR_RETURN(const auto nodes, CollectScenarios(file, text_of));
  std::vector<Scenario> scenarios;
  std::size_t values = 0;
  for (const Node& node : nodes) {
    ASSIGN_OR_RETURN(auto scenario, ParseScenario(node, file));
    values += scenario.conditions.size() * CountValues(node);
    if (values > kMaxFileValues) {
      return Fail(node.place, "with this scenario, the conditions of the file have more than {} values",
                  kMaxFileValues);
    }
    for (const Scenario& other : scenarios) {
      if (other.name != scenario.name) continue;
      return Fail(node.Find("scenario")->place, "two scenarios of this file have the name '{}'", other.name);
    }
    scenarios.push_back(std::move(scenario));
  }
  return scenarios;
}

}  // namespace

Result<std::vector<Scenario>> ReadScenarios(const std::string& file, SourceTexts& texts) {
  return ParseAll(file, [&](const std::string& path, const Place& asked_at) -> Result<std::string> {
    auto text = ReadWholeFile(path);
    if (text) return texts[path] = *std::move(text);
    if (asked_at.line == 0) return text;
    return Fail(asked_at, "{}", ToString(text.error()));
  });
}

Result<std::vector<Scenario>> ParseScenarios(const std::string& file, const SourceTexts& texts) {
  return ParseAll(file, [&](const std::string& path, const Place& asked_at) -> Result<std::string> {
    const auto text = texts.find(path);
    if (text == texts.end()) return Fail(asked_at, "the content of the file '{}' is missing", path);
    return text->second;
  });
}

}  // namespace etude
