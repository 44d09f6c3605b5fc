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

/// An outside program that takes one seat of a world's loop and is asked step by step (docs/outside-methods.md).
class LiveProgram {
 public:
  virtual ~LiveProgram() = default;
  /// Begins a session. Returns false if the program has failed.
  virtual bool Begin(const Payload& session) = 0;
  /// Asks for the next step. Returns the answer, an object whose numbers are finite. Returns null if the program has
  /// failed or gave no answer: the session is then over, and the caller of RunWith knows the reason.
  virtual JsonPtr Step(const Payload& step) = 0;
};

/// One world, built once, in which methods run one after the other. A method's answer depends on the world and the
/// method, never on which methods ran before. Stages that methods share are computed once.
class TaskWorld {
 public:
  virtual ~TaskWorld() = default;

  /// Returns why no method can run here ("clip x has no labelled moves"), or nothing. With a reason every cell is
  /// skipped.
  virtual std::optional<std::string> WhySkipped() const { return std::nullopt; }

  /// Computes the expensive stages that several built-in methods share, so that their time counts for none of them.
  virtual void PrepareShared() {}

  /// Runs the built-in method with this index in TaskInput::methods.
  virtual CellResult Run(std::size_t method) = 0;
  /// Runs a method with `program` in the seat that the method leaves open (TaskKind::seats). An answer of the wrong
  /// shape, size or range is an Error, as in Judge. If the program has failed, the result is ignored.
  virtual Result<CellResult> RunWith(LiveProgram& /*program*/, std::size_t /*method*/) {
    return Fail({}, "worlds of this task have no loop");
  }

  /// Returns the setting of this world alone, which outside methods get in place of Task::Setting if the task
  /// HasOwnSettings.
  virtual Result<Payload> MakeSetting() { return Fail({}, "worlds of this task share a setting"); }
  /// Returns the problem that outside methods are given in this world, in addition to the setting.
  virtual Result<Payload> MakeProblem() = 0;
  /// Returns the truth of this world, which `etude export` writes separately from the problem.
  virtual Result<Payload> MakeTruth() = 0;
  /// Makes the pictures of the truth (depth, labels), if the task has any, and passes each to `keep`.
  virtual Result<void> MakeTruePictures(const AttachmentSink& /*keep*/) { return {}; }
  /// Scores an answer as if a built-in method had given it. An answer of the wrong shape, size or range is an Error
  /// that names the position in the answer (e.g. "angles[3]"), the value found, and what is allowed.
  virtual Result<CellResult> Judge(const Json& answer) = 0;
};

/// One scenario under one condition (one value of each swept parameter). It can build the world of any trial.
class Task {
 public:
  virtual ~Task() = default;

  /// Builds the world of `key`, a pure function of its arguments. If `keeps_motion`, cells fill CellResult::recording.
  /// The task must outlive its worlds.
  virtual std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool keeps_motion) const = 0;

  /// Returns the names of the clips that this trial was drawn from, in the order of their roles (clip left, clip
  /// entered). Empty if a world uses no clip, or all of them.
  virtual std::vector<std::string> ClipsOf(const WorldKey& key) const = 0;

  /// Returns the data that all problems of this condition share (the body's tree, the library of clips, …). Outside
  /// methods receive it once, before their first problem.
  virtual Result<Payload> Setting() const = 0;

  /// Returns true if every world has a setting of its own (TaskWorld::MakeSetting).
  virtual bool HasOwnSettings() const { return false; }

  /// Returns the value of a metric for a method without an answer, if the metric defines one: 0 for a solved share,
  /// twice the limit for a penalised cost (PAR-2). Returns nothing for all other metrics: their value is missing.
  virtual std::optional<double> ValueOfFailure(std::string_view /*metric*/) const { return std::nullopt; }
};

struct ClipLibrary;
struct LabelledStreams;
struct OpenOptions;

/// One world of a task that judges files: the answer of each method, and a truth if the task has one.
struct JudgedFiles {
  std::string name;   ///< identifies the world; it does not depend on which other files exist
  std::string unit;   ///< the sampling unit to which the world belongs, such as a person; "" = its name
  std::string truth;  ///< a reference to a motion (io/clips/references.h); "" = the task knows no truths
  std::vector<std::string> answers;  ///< also references, by method; "" = the method has none of this name
  friend bool operator==(const JudgedFiles&, const JudgedFiles&) = default;
};

/// The worlds that a task found, and the files that it left out.
struct FoundFiles {
  std::vector<JudgedFiles> worlds;
  std::vector<std::pair<std::string, std::string>> left_out;  ///< a file, and the reason why it was left out
};

/// The parts of a scenario from which a task is made.
struct TaskInput {
  Fields& condition;              ///< the scenario's mapping with swept values inserted; the task reads its own keys
  std::span<const Node> methods;  ///< each a mapping with at least `name`
  const ClipLibrary& clips;
  /// The texts of the files that the condition names, by key (ValueKind::names_file).
  std::map<std::string, std::string> texts = {};
  /// The recordings that replace simulated people, if the scenario has `streams` or `labels`
  /// (engine/teaching/labelled_streams.h); they outlive the task.
  const LabelledStreams* recordings = nullptr;
  /// The worlds of a task that judges files (TaskKind::find_files), one a trial, and how their files are opened.
  std::span<const JudgedFiles> files = {};
  const OpenOptions* opening = nullptr;
};

/// A kind of task: one per folder of bench/tasks.
struct TaskKind {
  std::string name;
  std::string question;                      ///< one line, for `etude list`
  std::vector<std::string> default_metrics;  ///< the headline metrics of a report, most important first
  /// The metric that says how well a cell reached the task's goal: solved, recovered, clean, ….
  std::string success;
  std::vector<std::string> metrics;          ///< all metrics that its cells report, by a value or a reason
  Result<std::unique_ptr<Task>> (*make)(TaskInput& input);
  std::vector<KeyInfo> condition_keys;  ///< its keys in a scenario
  std::vector<KeyInfo> method_keys;     ///< its keys in a method, beside `name`
  /// The seats of its loop that a program may take, named by the method's key `seat`. The program is then asked step by
  /// step, and the method uses the task's keys for everything else.
  std::vector<std::string> seats = {};
  bool has_problems = true;      ///< whether a program may also be asked one question per world, without a seat
  bool uses_clips = true;        ///< whether its worlds use a scenario's `clips`
  bool uses_recordings = false;  ///< … or of its `streams`
  /// The units that its worlds are drawn from: the default first, then others that a scenario may name; at least one.
  std::vector<SamplingUnit> units = {SamplingUnit::kWorld};
  /// For a task that judges files instead of making worlds: finds the files, once, when a run is set up. Such a task
  /// draws no random numbers and asks no program. `texts` are as in TaskInput. Null if the task makes its worlds.
  Result<FoundFiles> (*find_files)(const Node& condition, std::span<const Node> methods,
                                   const std::map<std::string, std::string>& texts) = nullptr;
  std::vector<std::string> keys_of_files = {};  ///< the keys of the condition that only `find_files` reads
  /// Returns, for the manifest, the software that its results depend on in addition to the build: "4.5 (Core Profile)
  /// Mesa 22.3.6".
  std::string (*platform)() = nullptr;
};

}  // namespace etude
