#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/keys/key_info.h"
#include "bench/model/payload.h"
#include "bench/model/recording.h"
#include "bench/model/row.h"
#include "bench/model/unit.h"
#include "engine/document/fields.h"
#include "io/files/json.h"
#include "sim/random/stream.h"

namespace etude {

/// An outside program that does one part of a world's loop (its seat) and is asked in every step
/// (docs/outside-methods.md).
class LiveProgram {
 public:
  virtual ~LiveProgram() = default;
  /// Begins a session. Returns false if the program has failed.
  virtual bool Begin(const Payload& session) = 0;
  /// Sends the next step's data to the program. Returns the program's answer, an object whose numbers are finite.
  /// Returns null if the program has failed or gave no answer; the session is then over, and the caller of RunWith
  /// knows the reason.
  virtual JsonPtr Step(const Payload& step) = 0;
};

/// One world, built once, in which methods run one after the other. A method's answer depends on the world and on the
/// method, never on the methods that ran before. Stages that methods share are computed once.
class TaskWorld {
 public:
  virtual ~TaskWorld() = default;

  /// Returns the reason why no method can run in this world ("clip x has no labelled moves"); every cell is then
  /// skipped. Returns nothing if methods can run.
  virtual std::optional<std::string> WhySkipped() const { return std::nullopt; }

  /// Computes the expensive stages that several built-in methods share, so that their time does not count for any
  /// method.
  virtual void PrepareShared() {}

  /// Runs the built-in method with this index in TaskInput::methods.
  virtual CellResult Run(std::size_t method) = 0;
  /// Runs a method in which `program` replaces the part of the loop that the method's `seat` names (TaskKind::seats).
  /// Fails, like Judge, if an answer has a wrong shape, size or range. If the program has failed, the result is
  /// ignored.
  virtual Result<CellResult> RunWith(LiveProgram& /*program*/, std::size_t /*method*/) {
    return Fail({}, "worlds of this task have no loop");
  }

  /// Returns the setting of this world alone. If the task HasOwnSettings, outside methods receive it in place of
  /// Task::Setting.
  virtual Result<Payload> MakeSetting() { return Fail({}, "worlds of this task share a setting"); }
  /// Returns the problem of this world. Outside methods receive it after the setting.
  virtual Result<Payload> MakeProblem() = 0;
  /// Returns the truth of this world. `etude export` writes it separately from the problem.
  virtual Result<Payload> MakeTruth() = 0;
  /// Makes the pictures of the truth (depth, labels), if the task has any. Passes each picture to `keep`.
  virtual Result<void> MakeTruePictures(const AttachmentSink& /*keep*/) { return {}; }
  /// Scores an outside method's answer by the rules for built-in methods. Fails if the answer has a wrong shape, size
  /// or range. The error names the position in the answer (e.g. "angles[3]"), the value found, and what is allowed.
  virtual Result<CellResult> Judge(const Json& answer) = 0;
};

/// One scenario under one condition (one value of each swept parameter). A task can build the world of any trial.
class Task {
 public:
  virtual ~Task() = default;

  /// Builds the world of `key`. The world is a pure function of the arguments. If `keeps_motion`, cells fill
  /// CellResult::recording. The task must outlive its worlds.
  virtual std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool keeps_motion) const = 0;

  /// Returns the names of the clips from which this trial was drawn, in the order of their roles (playing clip, wanted
  /// clip). Empty if a world uses no clip, or uses all of them.
  virtual std::vector<std::string> ClipsOf(const WorldKey& key) const = 0;

  /// Returns the data that all problems of this condition share (the body's tree, the library of clips, …). Outside
  /// methods receive it once, before their first problem.
  virtual Result<Payload> Setting() const = 0;

  /// Returns true if every world has a setting of its own (TaskWorld::MakeSetting).
  virtual bool HasOwnSettings() const { return false; }

  /// Returns the value of a metric for a method without an answer, if the metric defines one: 0 for a solved share,
  /// twice the limit for a penalised cost (PAR-2). Returns nothing for all other metrics; their value is then missing.
  virtual std::optional<double> ValueOfFailure(std::string_view /*metric*/) const { return std::nullopt; }
};

struct ClipLibrary;
struct LabelledStreams;
struct OpenOptions;

/// One world of a task that judges files: the answer of each method, and the truth, if the task has truths.
struct JudgedFiles {
  std::string name;   ///< identifier of the world; it does not depend on which other files exist
  std::string unit;   ///< the sampling unit to which the world belongs, such as a person; "" = the world's name
  std::string truth;  ///< a reference to a motion (io/clips/references.h); "" = the task knows no truths
  std::vector<std::string> answers;  ///< references to motions, by method; "" = the method has no answer in this world
  /// The name of the first world whose truth is the same, apart from one rigid motion; "" = none. The two are one unit.
  std::string same_as = {};
  friend bool operator==(const JudgedFiles&, const JudgedFiles&) = default;
};

/// A file or folder that a task left out, and the reason.
using LeftOutFile = std::pair<std::string, std::string>;

/// The worlds that a task found, and the files that it left out.
struct FoundFiles {
  std::vector<JudgedFiles> worlds;
  std::vector<LeftOutFile> left_out;
};

/// The parts of a scenario from which a task is made.
struct TaskInput {
  Fields& condition;              ///< the scenario's mapping with swept values inserted; the task reads its own keys
  std::span<const Node> methods;  ///< one mapping per method, with at least the key `name`
  const ClipLibrary& clips;
  /// The texts of the files that the condition names, by the condition's key (ValueKind::names_file).
  std::map<std::string, std::string> texts = {};
  /// The recordings that replace simulated people, if the scenario has `streams` or `labels`
  /// (engine/teaching/labelled_streams.h); else null. They outlive the task.
  const LabelledStreams* recordings = nullptr;
  /// The worlds of a task that judges files (TaskKind::find_files), one per trial, and the options for opening their
  /// files.
  std::span<const JudgedFiles> files = {};
  const OpenOptions* opening = nullptr;
};

/// A kind of task. Each folder of bench/tasks defines one.
struct TaskKind {
  std::string name;
  std::string question;                      ///< the question that the task asks, in one line, for `etude list`
  std::vector<std::string> default_metrics;  ///< the headline metrics of a report, most important first
  /// The metric that says how well a cell reached the task's goal (solved, recovered, clean, …).
  std::string success;
  std::vector<std::string> metrics;  ///< all metrics that the task's cells report, by a value or by a reason
  Result<std::unique_ptr<Task>> (*make)(TaskInput& input);
  std::vector<KeyInfo> condition_keys;  ///< the keys that the task adds to a scenario
  std::vector<KeyInfo> method_keys;     ///< the keys that the task adds to a method, except `name`
  /// The seats of the task: the parts of the loop that a program may replace. The method's key `seat` names one. The
  /// program is then asked step by step. The task's keys configure everything else of the method.
  std::vector<std::string> seats = {};
  bool has_problems = true;      ///< true: a program without a seat may be asked one question per world
  bool uses_clips = true;        ///< true: the task's worlds use a scenario's `clips`
  bool uses_recordings = false;  ///< true: the task's worlds use a scenario's `streams`
  /// The units from which worlds are drawn. The first is the default; a scenario may name one of the others. The list
  /// is never empty.
  std::vector<SamplingUnit> units = {SamplingUnit::kWorld};
  /// Finds the files of a task that judges files, once, when a run is set up. Such a task draws no random numbers and
  /// asks no program. `texts` are those of TaskInput. Null if the task makes its worlds.
  Result<FoundFiles> (*find_files)(const Node& condition, std::span<const Node> methods,
                                   const std::map<std::string, std::string>& texts) = nullptr;
  std::vector<std::string> keys_of_files = {};  ///< the keys of the condition that only `find_files` reads
  /// Returns the software that the task's results depend on in addition to the build, for the manifest: "4.5 (Core
  /// Profile) Mesa 22.3.6". Null if there is none.
  std::string (*platform)() = nullptr;
  double success_matters = 0.05;  ///< the smallest difference of success that matters, unless a scenario states it
  /// Finds, for a task that judges files, the worlds with equal truths, and sets their JudgedFiles::same_as. Null if
  /// the task has no truths.
  void (*find_equal_truths)(std::vector<JudgedFiles>& worlds, const OpenOptions& opening) = nullptr;
};

}  // namespace etude
