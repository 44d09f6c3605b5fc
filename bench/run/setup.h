#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/scenario/scenario.h"
#include "bench/tasks/base/task.h"
#include "engine/teaching/labelled_streams.h"
#include "io/clips/clip_library.h"
#include "io/files/json.h"
#include "sim/random/seed.h"

namespace etude {

/// The most cells of one run: the places of their rows are held in memory.
inline constexpr std::size_t kMaxCells = 10'000'000;

/// A clip or a recording that a run leaves out because it cannot be read or understood.
struct RefusedClip {
  std::string clip;  ///< a reference
  std::string why;
  friend bool operator==(const RefusedClip&, const RefusedClip&) = default;
};

/// The inputs of a scenario's worlds beside the texts that it stands in: enough to make them again anywhere.
struct ScenarioSetup {
  std::string file;  ///< a key of SuiteSetup::sources
  std::string name;  ///< a file may hold several scenarios
  Seed seed = 1;
  int trials = 1;
  std::vector<std::string> clips;          ///< references; the scenario's own, or those of --clips
  std::string joint_map;                   ///< a key of SuiteSetup::sources, "" = none
  std::string digest;                      ///< of the texts that the scenario stands in
  std::vector<NamedClips> libraries = {};  ///< the scenario's own, and those of --library
  std::vector<std::string> streams = {};   ///< recordings; the scenario's own, or those of --streams
  std::vector<std::string> labels = {};    ///< keys of SuiteSetup::sources
  std::vector<RefusedClip> refused = {};   ///< what `clips`, `libraries` and `streams` were to name as well
  bool keeps_motions = false;              ///< of every cell (--keep motions), not of those alone that `video` names
};

/// A method whose answers are known already (etude score).
struct ScoredMethod {
  std::string name;
  bool alone = false;  ///< in the place of the scenarios' own methods, not beside them
};

/// The version of what secret worlds are made of. Version 2 disguises clips (bench/tasks/base/disguise.h); version 3
/// throws dice of its own for every condition.
inline constexpr int kSecretWorldsVersion = 3;

/// The set-up of a suite, which the manifest keeps and every worker is started with.
struct SuiteSetup {
  std::string suite;
  Seed seed = 1;
  SourceTexts sources;
  std::vector<ScenarioSetup> scenarios;
  std::optional<ScoredMethod> scored;        ///< a method of every scenario, too
  int secret_worlds = kSecretWorldsVersion;  ///< of a secret seed
  /// The manifest's names of `sources` that are known by other names here (CanonicalNames); people are shown names as
  /// they were given.
  std::map<std::string, std::string> canonical = {};
  /// The scenarios of those files of `sources` that were parsed already, as they stand there.
  std::map<std::string, std::vector<Scenario>> parsed = {};
};

/// Encodes a set-up; of secret seeds the digest alone.
Json EncodeSetup(const SuiteSetup& setup);
/// Complains of what is no set-up, names no scenario, or asks for no trials or too many.
Result<SuiteSetup> DecodeSetup(const Json& json, const Place& place);

/// A scenario with its clips loaded and its tasks made: ready to run any of its worlds.
class PreparedScenario {
 public:
  const ScenarioSetup& setup() const { return setup_; }
  const Scenario& scenario() const { return scenario_; }
  /// The clips, those of all libraries where there are any.
  const ClipLibrary& clips() const { return *clips_; }
  /// Returns the clip libraries by name, where there are any.
  const std::map<std::string, ClipLibrary>& libraries() const { return libraries_; }
  /// The recordings of people that its worlds are made of; null where they are not.
  const LabelledStreams* recordings() const { return recordings_.get(); }
  const Task& task(int condition) const { return *tasks_[condition]; }

  /// The key of the dice of a trial under a condition. Conditions of open worlds share it; secret worlds have one for
  /// every condition, since two worlds of the same dice and of different noise tell their truth together.
  WorldKey KeyOf(int condition, int trial) const { return {setup_.seed, dice_names_[condition], trial}; }
  /// A cell's row before anything is known about its result.
  Row IdentityOf(int condition, int trial, std::size_t method) const;
  /// The row of a cell that ended without measurements.
  Row EndedRow(int condition, int trial, std::size_t method, Status status, const std::string& reason) const;
  /// Names every metric of the task that `row` does not report: with the value that failing has, else as
  /// missing for the row's reason.
  void CompleteMetrics(int condition, Row& row) const;

 private:
  friend Result<PreparedScenario> Prepare(const SuiteSetup& suite, const ScenarioSetup& setup, Scenario scenario);

  const ClipLibrary& ClipsOf(const Condition& condition) const {
    return condition.library.empty() ? *clips_ : libraries_.at(condition.library);
  }

  ScenarioSetup setup_;
  Scenario scenario_;
  std::unique_ptr<ClipLibrary> clips_;
  std::map<std::string, ClipLibrary> libraries_;  ///< by name
  std::unique_ptr<LabelledStreams> recordings_;
  std::vector<std::unique_ptr<Task>> tasks_;  ///< one per condition
  std::vector<std::string> dice_names_;       ///< by condition: WorldKey::scenario
};

/// True if a task of another kind sees by the cameras of the capture task.
bool IsFilmed(const Scenario& scenario);

/// The number of people that a scenario's recordings show; nothing where its worlds are not made of them. `texts` hold
/// its labels. Files of its folders and patterns that cannot be read are added to `setup.refused`.
Result<std::optional<int>> CountRecordedPeople(ScenarioSetup& setup, const StreamSource& source,
                                               const SourceTexts& texts);

/// Finds the scenarios of a suite, which must outlive it; each file is parsed once.
class ParsedSuite {
 public:
  explicit ParsedSuite(const SuiteSetup& suite) : suite_(suite) {}
  /// The scenario of `setup`, with its trials and libraries. Fails where the suite's texts do not hold it.
  Result<Scenario> Find(const ScenarioSetup& setup);

 private:
  const SuiteSetup& suite_;
  std::map<std::string, std::vector<Scenario>> parsed_;  ///< by file
};

/// Loads the clips of a scenario (ParsedSuite::Find) and makes its tasks; every complaint about its methods' keys or
/// its clips comes from here.
Result<PreparedScenario> Prepare(const SuiteSetup& suite, const ScenarioSetup& setup, Scenario scenario);
/// Prepares all scenarios of a suite. Refuses more than kMaxCells cells.
Result<std::vector<PreparedScenario>> PrepareAll(const SuiteSetup& suite);

/// Puts the method behind those of the file, compared with the first, or in their place, with nothing expected. Fails
/// when its name is taken or no name.
Result<void> AddScoredMethod(const ScoredMethod& method, Scenario& scenario);

}  // namespace etude
