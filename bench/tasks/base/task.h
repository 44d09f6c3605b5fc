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
#include "io/drawing/sensor_sheet.h"
#include "io/files/json.h"
#include "sim/random/stream.h"

namespace etude {

/// A program that takes one seat of a world's loop, asked step by step (docs/outside-methods.md).
class LiveProgram {
 public:
  virtual ~LiveProgram() = default;
  /// A session begins; false when the program has failed.
  virtual bool Begin(const Payload& session) = 0;
  /// Asks the next step; returns the answer: an object whose numbers are finite. Null when it has failed, or gave no
  /// answer: then the session is over, and whoever called the world's Run knows why.
  virtual JsonPtr Step(const Payload& step) = 0;
};

/// One world, built once, in which methods run one after the other. What a method answers depends on the
/// world and on the method, never on which others ran before; stages that methods share are computed once.
class TaskWorld {
 public:
  virtual ~TaskWorld() = default;

  /// Returns why no method can run here ("clip x has no labelled moves"), else nothing. With a reason every cell is
  /// skipped.
  virtual std::optional<std::string> WhySkipped() const { return std::nullopt; }

  /// Computes the costly stages that several built-in methods share, so that none of them is charged with their time.
  virtual void PrepareShared() {}

  /// Runs a built-in method: its index in TaskInput::methods.
  virtual CellResult Run(std::size_t method) = 0;
  /// Runs a method with `program` in the seat that the method leaves to it (TaskKind::seats). What the program says in
  /// the wrong shape, size or range is an Error, as of Judge. What is told when the program has failed is thrown away.
  virtual Result<CellResult> RunWith(LiveProgram& /*program*/, std::size_t /*method*/) {
    return Fail({}, "worlds of this task have no loop");
  }

  /// The question put to methods outside in this world, beside Task::Setting.
  virtual Result<Payload> MakeProblem() = 0;
  /// The truth of this world, which `etude export` writes apart from the problem.
  virtual Result<Payload> MakeTruth() = 0;
  /// Scores an answer as if a built-in method had given it. An answer of the wrong shape, size or range is
  /// an Error that names where in the answer (e.g. "angles[3]"), what was found, and what is allowed.
  virtual Result<CellResult> Judge(const Json& answer) = 0;

  /// Pictures of what the sensors see, and of what each of their effects does to it.
  virtual Result<SensorSheet> MakeSensorSheet() { return Fail({}, "worlds of this task hold no pictures"); }
};

/// One scenario under one condition (one value of each swept parameter), ready to run any trial.
class Task {
 public:
  virtual ~Task() = default;

  /// Builds the world of `key`, a pure function of its arguments. `keeps_motion`: cells fill CellResult::recording.
  /// The task must outlive its worlds.
  virtual std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool keeps_motion) const = 0;

  /// The names of the clips that this trial was drawn from, in the order of their parts (clip left, clip entered). None
  /// where a world is made of no clip, or of all of them.
  virtual std::vector<std::string> ClipsOf(const WorldKey& key) const = 0;

  /// The data that all problems of this condition share (the body's tree, the library of clips, …): told to methods
  /// outside once, before their first problem.
  virtual Result<Payload> Setting() const = 0;

  /// The value of a metric for a method that gave no answer, where failing has one: 0 for a solved share, twice
  /// the limit for a penalised cost (PAR-2). Nothing for every other metric: its value is missing.
  virtual std::optional<double> ValueOfFailure(std::string_view /*metric*/) const { return std::nullopt; }
};

struct ClipLibrary;
struct LabelledStreams;

/// The parts of a scenario that a task is made from.
struct TaskInput {
  Fields& condition;              ///< the scenario's mapping, swept keys replaced; the task reads its own keys
  std::span<const Node> methods;  ///< each a mapping with at least `name`
  const ClipLibrary& clips;
  /// The texts of the files that the condition names, by key (ValueKind::names_file).
  std::map<std::string, std::string> texts = {};
  /// The recordings that stand in place of simulated people, where the scenario has `streams` or `labels`
  /// (engine/teaching/labelled_streams.h); outlives the task.
  const LabelledStreams* recordings = nullptr;
};

/// A kind of question that can be asked: one entry per folder of bench/tasks.
struct TaskKind {
  std::string name;
  std::string question;                      ///< one line, for `etude list`
  std::vector<std::string> default_metrics;  ///< the headline metrics of a report, most important first
  std::vector<std::string> metrics;          ///< all that its cells report, value or reason
  Result<std::unique_ptr<Task>> (*make)(TaskInput& input);
  std::vector<KeyInfo> condition_keys;  ///< its keys of a scenario
  std::vector<KeyInfo> method_keys;     ///< its keys of a method, beside `name`
  /// The seats of a loop that a program may take, named by its method's key `seat`; then it is spoken to step by step,
  /// and the method has the task's keys for all else.
  std::vector<std::string> seats = {};
  bool has_problems = true;      ///< whether a program may also be asked one question a world, without a seat
  bool uses_clips = true;        ///< whether its worlds are made of a scenario's `clips`
  bool uses_recordings = false;  ///< … or of its `streams`
  /// The units that its worlds are drawn from: its own first, then others that a scenario may name; at least one.
  std::vector<SamplingUnit> units = {SamplingUnit::kWorld};
  /// Tells what its bytes depend on beside the build, for the manifest: "4.5 (Core Profile) Mesa 22.3.6".
  std::string (*platform)() = nullptr;
};

}  // namespace etude
