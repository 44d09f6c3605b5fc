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

/// The maximum number of cells of one run. A run keeps 16 bytes per cell in memory.
inline constexpr std::size_t kMaxCells = 10'000'000;

/// A clip or a recording that a run leaves out because it cannot be read or understood.
struct RefusedClip {
  std::string clip;
  std::string why;
  friend bool operator==(const RefusedClip&, const RefusedClip&) = default;
};

/// The inputs from which a scenario's worlds are made. With SuiteSetup::sources and the files of the clips and
/// recordings, the same worlds can be made on any machine.
struct ScenarioSetup {
  std::string file;  ///< name of the scenario's file, a key of SuiteSetup::sources
  std::string name;  ///< name of the scenario; a file may contain several scenarios
  Seed seed = 1;
  int trials = 1;
  std::vector<std::string> clips;          ///< references to clips: the scenario's own, or those of the option --clips
  std::string joint_map;                   ///< name of the joint map, a key of SuiteSetup::sources; "" = none
  std::string digest;                      ///< digest of the scenario's texts
  std::vector<NamedClips> libraries = {};  ///< the scenario's own clip libraries, and those of the option --library
  /// References to recordings: the scenario's own, or those of the option --streams.
  std::vector<std::string> streams = {};
  std::vector<std::string> labels = {};   ///< names of label files, keys of SuiteSetup::sources
  std::vector<RefusedClip> refused = {};  ///< files left out of `clips`, `libraries`, `streams` and `files`
  std::vector<JudgedFiles> files = {};    ///< the worlds of a task that judges files, by trial
  /// True: every cell is recorded (--keep motions); false: only the cells that `video` names.
  bool keeps_motions = false;
};

/// Returns the sampling unit of a run's worlds: the scenario's unit, or the person if it is known whom the judged files
/// show (JudgedFiles::unit), because several files may show the same person.
SamplingUnit SampledUnit(const Scenario& scenario, const ScenarioSetup& setup);

/// A method whose answers are read from files and scored; it is not run (etude score).
struct ScoredMethod {
  std::string name;
  bool alone = false;  ///< true: the scored method replaces the scenarios' own methods; false: it is added to these
                       ///< methods
};

/// The version of the rule by which secret worlds are made. Version 2 introduced disguised clips
/// (bench/tasks/base/disguise.h); version 3 gave every condition its own random numbers.
inline constexpr int kSecretWorldsVersion = 3;

/// The set-up of a suite. The manifest stores it, and every worker receives it.
struct SuiteSetup {
  std::string suite;
  Seed seed = 1;
  SourceTexts sources;
  std::vector<ScenarioSetup> scenarios;
  std::optional<ScoredMethod> scored;  ///< a method with answers from files, added to every scenario; nullopt = none
  /// Version of the rule by which secret worlds are made; matters only if the seed is secret.
  int secret_worlds = kSecretWorldsVersion;
  /// Maps the names of texts in `sources` to their names in the manifest. A name that is not listed is the same in the
  /// manifest (CanonicalNames). Error messages show the names that the user gave.
  std::map<std::string, std::string> canonical = {};
  /// A cache of the scenarios that have been parsed, by file name in `sources`.
  std::map<std::string, std::vector<Scenario>> parsed = {};
};

/// Returns the files that the scenarios leave out, each listed once.
std::vector<RefusedClip> LeftOutOf(const SuiteSetup& setup);

/// Encodes a set-up as JSON. A secret seed is represented by its digest alone.
Json EncodeSetup(const SuiteSetup& setup);
/// Reads a set-up from JSON. Fails if the JSON is not a set-up, contains no scenario, or has a scenario with no or too
/// many trials.
Result<SuiteSetup> DecodeSetup(const Json& json, const Place& place);

/// A scenario with its clips loaded and its tasks made, so that any of its worlds can be run.
class PreparedScenario {
 public:
  const ScenarioSetup& setup() const { return setup_; }
  const Scenario& scenario() const { return scenario_; }
  /// Returns the clips of the scenario. If the scenario has clip libraries, returns the clips of all libraries.
  const ClipLibrary& clips() const { return *clips_; }
  const std::map<std::string, ClipLibrary>& libraries() const { return libraries_; }
  /// Returns the recordings of people from which the worlds are made; null if worlds are not made from recordings.
  const LabelledStreams* recordings() const { return recordings_.get(); }
  const Task& task(int condition) const { return *tasks_[condition]; }
  const OpenOptions& opening() const { return *opening_; }

  /// Returns the key from which the random numbers of a trial under a condition are derived. If the seed is plain, all
  /// conditions share this key. If the seed is secret, each condition has its own key: two worlds with the same random
  /// numbers and different noise would together reveal the ground truth.
  WorldKey KeyOf(int condition, int trial) const { return {setup_.seed, dice_names_[condition], trial}; }
  /// Returns a cell's row, still without a result.
  Row IdentityOf(int condition, int trial, std::size_t method) const;
  Row EndedRow(int condition, int trial, std::size_t method, Status status, const std::string& reason) const;
  /// Adds the metrics that `row` lacks, unless its status is ok. Each added metric gets the value that the task defines
  /// for failed cells. If the task defines none, or if the cell was skipped, the metric is missing, with the row's
  /// reason.
  void CompleteMetrics(int condition, Row& row) const;

 private:
  friend Result<PreparedScenario> Prepare(const SuiteSetup& suite, const ScenarioSetup& setup, Scenario scenario);

  const ClipLibrary& ClipsOf(const Condition& condition) const {
    return condition.library.empty() ? *clips_ : libraries_.at(condition.library);
  }

  ScenarioSetup setup_;
  Scenario scenario_;
  std::unique_ptr<ClipLibrary> clips_;
  std::map<std::string, ClipLibrary> libraries_;
  std::unique_ptr<LabelledStreams> recordings_;
  std::unique_ptr<OpenOptions> opening_;
  std::vector<std::unique_ptr<Task>> tasks_;  ///< the task of each condition
  /// Names from which random numbers are derived, one per condition (WorldKey::scenario).
  std::vector<std::string> dice_names_;
};

/// Finds the files of a scenario whose task judges files, and stores the worlds made of them in `setup.files`. Does
/// nothing for other tasks. Files that are left out are added to `setup.refused`. Fails if two conditions of the
/// scenario judge different files.
Result<void> FindFiles(const Scenario& scenario, const SourceTexts& texts, ScenarioSetup& setup);

/// Returns the options with which the motions of a scenario are opened.
Result<OpenOptions> OpenOptionsOf(const ScenarioSetup& setup, const SourceTexts& texts);

/// Returns true if a condition of the scenario has `sensor: cameras`. The scenario's task then uses the cameras of task
/// capture.
bool IsFilmed(const Scenario& scenario);
/// Returns true if making the scenario's worlds needs the renderer.
bool Draws(const Scenario& scenario);

/// Returns the number of people in a scenario's recordings; nullopt if its worlds are not made from recordings. `texts`
/// contains the labels. Files in the folders and patterns of `setup.streams` that cannot be read are added to
/// `setup.refused`.
Result<std::optional<int>> CountRecordedPeople(ScenarioSetup& setup, const StreamSource& source,
                                               const SourceTexts& texts);

/// Finds the scenarios of a suite. The suite must outlive this object. Each file is parsed once.
class ParsedSuite {
 public:
  explicit ParsedSuite(const SuiteSetup& suite) : suite_(suite) {}
  /// Returns the scenario that `setup` names, with the trials and libraries of `setup`. Fails if the suite's texts do
  /// not contain this scenario.
  Result<Scenario> Find(const ScenarioSetup& setup);

 private:
  const SuiteSetup& suite_;
  std::map<std::string, std::vector<Scenario>> parsed_;
};

/// Loads the clips of a scenario (from ParsedSuite::Find) and makes its tasks. Fails if a clip, or a key of a method,
/// is invalid.
Result<PreparedScenario> Prepare(const SuiteSetup& suite, const ScenarioSetup& setup, Scenario scenario);
/// Prepares all scenarios of a suite. Fails if there are more than kMaxCells cells.
Result<std::vector<PreparedScenario>> PrepareAll(const SuiteSetup& suite);

/// Adds `method`, whose answers come from files, as the last method of the scenario. It is compared with the scenario's
/// first method. If `method.alone` is true, it replaces all methods, and the expectations and gate rules are dropped.
/// Fails if its name is in use or is not a plain name.
Result<void> AddScoredMethod(const ScoredMethod& method, Scenario& scenario);

}  // namespace etude
