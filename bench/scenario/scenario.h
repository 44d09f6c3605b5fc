#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/keys/field_table.h"
#include "bench/metrics/catalogue.h"
#include "bench/model/study.h"
#include "bench/tasks/base/task.h"
#include "engine/document/node.h"
#include "engine/streams/stream_maker.h"

namespace etude {

/// Clips that belong together, such as a user's dances: worlds are made of one such library at a time.
struct NamedClips {
  std::string name;
  std::vector<std::string> clips;  ///< references as written
};

/// Recordings of people, which worlds are made of in place of simulated ones.
struct StreamSource {
  std::vector<std::string> files;  ///< references as written
  std::string labels;              ///< file, or folder of tag streams, that says what was done in streams or clips
  StreamReading reading;
  StreamOptions making;
};

/// One value of each swept parameter, and the scenario's mapping with those values put in.
struct Condition {
  std::vector<SweptValue> swept;  ///< empty when nothing is swept; a library's name first, where there are any
  Node node;
  std::string library = {};  ///< whose clips its worlds are made of; "" = the scenario's
};

/// A value of a condition that names a file.
struct NamedFile {
  std::string key;
  const Node* node = nullptr;  ///< its scalar is the file, within the condition
};
/// The values by which `condition` names files, in the order of the task's keys (ValueKind::names_file).
std::vector<NamedFile> FilesNamedBy(const Condition& condition, const TaskKind& kind);

/// The cells that keep their motions for videos.
struct RecordingSelection {
  std::vector<std::string> methods;
  std::vector<int> trials;

  bool KeepsTrial(int trial) const;
  bool KeepsMethod(std::string_view name) const;
};

/// One of the methods compared.
struct MethodEntry {
  std::string name;
  std::string against;            ///< the method it is compared with; the first is its own
  Node node;                      ///< the mapping that its task reads; unused for a method outside without a seat
  std::vector<std::string> exec;  ///< a method outside: program and arguments; empty = built in
  std::string options_json;       ///< a method outside: what its key `options` holds, told to it as it is
  std::optional<double> time_s;   ///< a method outside: its own limit per problem or step, instead of Limits::time_s
  std::string seat = {};          ///< a method outside: its seat in the task's loop; "" = it is asked once a world
  std::vector<std::string> files = {};  ///< a method outside: what a fence shows it; empty = its program's own folder
  std::string description = {};         ///< what it is, in a sentence, for those who read results; "" = nobody said

  /// True when its task runs it, wholly or around its seat.
  bool RunsInTask() const { return exec.empty() || !seat.empty(); }
};

/// A cell of which a metric's value is known.
struct MetricExample {
  std::string title;
  std::string cell_json;           ///< an object as the metric's program is given it: `tracks`, `extras`
  std::optional<double> expected;  ///< nothing: the metric has no value
  double tolerance = 1e-9;         ///< absolute
  Place place;
};

/// A metric that another program measures on the motions of a cell (docs/outside-methods.md).
struct OutsideMetric {
  MetricInfo info;
  MethodEntry program;  ///< its name is the metric's
  std::vector<MetricExample> vectors;
};

/// The time and memory that one cell, or the building of one world, may take before it is ended.
struct Limits {
  double time_s = 300;
  double memory_mb = 4096;  ///< resident, of the worker and of the methods outside that it has started, each
};

/// A question put to several methods on the same worlds (docs/scenarios.md), as its file says it. The keys
/// of its task are read by the task itself, from each condition's mapping.
struct Scenario {
  std::string file;
  std::string name;
  std::string question;
  std::string description;  ///< what its worlds are, in a sentence; "" = nobody said
  std::string task;
  std::vector<std::string> clips;     ///< references as written
  std::vector<NamedClips> libraries;  ///< instead of `clips`: every condition once for each
  StreamSource streams;
  std::string joint_map;  ///< file that teaches the joints of the clips (docs/clips.md), "" = none
  SamplingUnit unit = SamplingUnit::kWorld;
  int trials = 10;
  std::optional<std::uint64_t> seed;
  std::vector<Condition> conditions;                ///< at least one
  std::vector<MethodEntry> methods;                 ///< at least one
  std::vector<std::string> metrics;                 ///< headline metrics; the task's own when the file names none
  std::vector<OutsideMetric> outside_metrics = {};  ///< those that other programs measure; headline metrics, too
  std::vector<std::string> across;  ///< swept parameters under all of whose values a verdict must be the same
  std::string rival;                ///< "" = the best method is found
  std::vector<Expectation> expectations;
  RecordingSelection recordings;
  Limits limits;
  GateRules gate;
};

std::vector<std::string> MethodNames(const Scenario& scenario);

/// A program that a scenario starts.
struct ScenarioProgram {
  const MethodEntry* entry = nullptr;
  const char* role = "method";  ///< or "metric"
};
/// The methods that are programs, then the metrics.
std::vector<ScenarioProgram> ProgramsIn(const Scenario& scenario);

/// Adds those of `libraries` whose names the scenario does not know: all of its conditions once more for each. A
/// scenario without libraries has those alone from then on.
void AddLibraries(std::span<const NamedClips> libraries, Scenario& scenario);

/// The texts of scenario files and of all that they include, by path: what a manifest keeps of them.
using SourceTexts = std::map<std::string, std::string>;

/// The scenarios of a file on disk, as ParseScenarios; the texts that it and what it includes hold go into `texts`.
Result<std::vector<Scenario>> ReadScenarios(const std::string& file, SourceTexts& texts);

/// All scenarios of one file, in order. Everything is checked here but the values of the tasks' own keys, which the
/// tasks read (`bench/run`). A key that is not documented (bench/scenario/keys.h) is refused.
Result<std::vector<Scenario>> ParseScenarios(const std::string& file, const SourceTexts& texts);

/// The keys of every scenario, whatever its task.
std::span<const KeyInfo> CommonScenarioKeys();
const FieldTable<Limits>& LimitFields();
const FieldTable<StreamSource>& ReadingFields();
/// Names methods of `scenario`, which must outlive it.
FieldTable<RecordingSelection> VideoFields(const Scenario& scenario);

/// The part of a scenario by which its rows are judged.
Study StudyOf(const Scenario& scenario);

}  // namespace etude
