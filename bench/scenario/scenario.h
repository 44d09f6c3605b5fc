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

/// Clips that belong together, such as one user's dances. Each world uses the clips of one library.
struct NamedClips {
  std::string name;
  std::vector<std::string> clips;  ///< references to clips, as the file writes them
};

/// Recordings of people. Worlds are made from them instead of from simulated people.
struct StreamSource {
  std::vector<std::string> files;  ///< references to recordings, as the file writes them
  /// File with the labels of performances in streams or clips (a tag stream), or a folder of such files.
  std::string labels;
  StreamReading reading;
  StreamOptions making;
};

/// A condition: one value of each swept parameter, and the scenario's mapping with these values inserted.
struct Condition {
  /// The swept parameters, after the library's name if there are libraries; empty if nothing is swept.
  std::vector<SweptValue> swept;
  Node node;
  std::string library = {};  ///< the library of the condition's worlds; "" = the scenario's `clips`
};

/// A value of a condition that is the name of a file.
struct NamedFile {
  std::string key;
  const Node* node = nullptr;  ///< the node, in the condition's mapping, whose scalar is the file's name
};
/// Returns the values of `condition` that are names of files (ValueKind::names_file), in the order of the task's keys.
std::vector<NamedFile> FilesNamedBy(const Condition& condition, const TaskKind& kind);

/// Selects the cells whose motions are kept for videos.
struct RecordingSelection {
  std::vector<std::string> methods;
  std::vector<int> trials;

  bool KeepsTrial(int trial) const;
  bool KeepsMethod(std::string_view name) const;
};

struct MethodEntry {
  std::string name;
  std::string against;            ///< the method with which this method is compared; the first method is compared with
                                  ///< itself
  Node node;                      ///< the mapping that the task reads; not used for an outside method without a seat
  std::vector<std::string> exec;  ///< an outside method's program and arguments; empty = built in
  std::vector<Place> exec_places = {};  ///< the place of each word of `exec` in the scenario's file
  std::string options_json;             ///< an outside method's `options`, sent to it unchanged
  std::optional<double> time_s;  ///< an outside method's own limit per problem or step, instead of Limits::time_s
  std::string seat = {};         ///< an outside method's seat in the task's loop; "" = the method is asked once per
                                 ///< world
  std::vector<std::string> files = {};  ///< files that a sandbox shows to the program; empty = the program's own folder
  std::string description = {};         ///< a sentence about the method, for readers of the results; "" = not described

  /// Returns true if the task runs stages of the method: all stages of a built-in method, or the stages other than the
  /// seat of a program.
  bool RunsInTask() const { return exec.empty() || !seat.empty(); }
};

/// A test vector of an outside metric: a cell for which the metric's value is known.
struct MetricExample {
  std::string title;
  std::string cell_json;           ///< an object with `tracks` and `extras`, as the metric's program receives it
  std::optional<double> expected;  ///< the known value; nullopt = the metric has no value
  double tolerance = 1e-9;         ///< absolute tolerance, in the metric's unit
  Place place;
};

/// A metric that an outside program measures on the motions of a cell (docs/outside-methods.md).
struct OutsideMetric {
  MetricInfo info;
  MethodEntry program;  ///< the program; its name is also the metric's name
  std::vector<MetricExample> vectors;
};

/// The time and memory that one cell, or the building of one world, may use. If a limit is exceeded, Etude ends the
/// cell or stops building the world.
struct Limits {
  double time_s = 300;
  double memory_mb = 4096;  ///< limit of the resident memory of the worker, and of each outside method
};

/// A scenario as its file states it: a question that several methods answer in the same worlds (docs/scenarios.md). The
/// task reads its own keys from each condition's mapping.
struct Scenario {
  std::string file;
  std::string name;
  std::string question;
  std::string description;  ///< a sentence about the scenario's worlds; "" = not described
  std::string task;
  std::vector<std::string> clips;     ///< references to clips, as the file writes them
  std::vector<NamedClips> libraries;  ///< libraries in place of `clips`; every condition is repeated for each library
  StreamSource streams;
  std::string joint_map;  ///< file that maps the joints of the clips to roles (docs/clips.md); "" = none
  SamplingUnit unit = SamplingUnit::kWorld;
  int trials = 10;
  std::optional<std::uint64_t> seed;
  std::vector<Condition> conditions;                ///< at least one condition
  std::vector<MethodEntry> methods;                 ///< at least one method
  std::vector<std::string> metrics;                 ///< headline metrics; the task's default if the file names none
  std::string success = {};                         ///< metric of success; the task's default if the file names none
  double success_matters = 0.05;                    ///< the smallest difference of success that matters, as a share
  std::vector<OutsideMetric> outside_metrics = {};  ///< metrics that outside programs measure; also in `metrics`
  std::vector<std::string> across;  ///< swept parameters; a verdict must be the same under all their values
  std::string rival;                ///< the method that others must beat; "" = the best method is found
  std::vector<Expectation> expectations;
  RecordingSelection recordings;
  Limits limits;
  GateRules gate;
};

std::vector<std::string> MethodNames(const Scenario& scenario);

/// An outside program that a scenario starts.
struct ScenarioProgram {
  const MethodEntry* entry = nullptr;
  const char* role = "method";  ///< "method" or "metric"

  bool IsMetric() const { return std::string_view(role) == "metric"; }
};
/// Returns the methods that are programs, and then the metrics that are programs.
std::vector<ScenarioProgram> ProgramsIn(const Scenario& scenario);

/// Adds the libraries whose names the scenario does not have yet, and repeats all conditions for each of these
/// libraries. Conditions without a library are dropped.
void AddLibraries(std::span<const NamedClips> libraries, Scenario& scenario);

/// The texts of scenario files and of all included files, by path. A manifest stores them.
using SourceTexts = std::map<std::string, std::string>;

/// Reads the scenarios of a file on disk (ParseScenarios). Adds the texts of the file and of all included files to
/// `texts`.
Result<std::vector<Scenario>> ReadScenarios(const std::string& file, SourceTexts& texts);

/// Parses all scenarios of one file, in order. Checks everything except the values of the tasks' own keys, which the
/// tasks read later (`bench/run`). A key that is not documented (bench/scenario/keys.h) is an error.
Result<std::vector<Scenario>> ParseScenarios(const std::string& file, const SourceTexts& texts);

/// Returns the keys that scenarios of every task have.
std::span<const KeyInfo> CommonScenarioKeys();
const FieldTable<Limits>& LimitFields();
const FieldTable<StreamSource>& ReadingFields();
/// Returns the keys of `video`. The values of some keys name methods of `scenario`, which must outlive the table.
FieldTable<RecordingSelection> VideoFields(const Scenario& scenario);

}  // namespace etude
