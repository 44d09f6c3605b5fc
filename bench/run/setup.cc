#include "bench/run/setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "bench/run/recorded_motions.h"
#include "bench/scenario/judging.h"
#include "bench/scenario/methods.h"
#include "bench/tasks/base/sensor_key.h"
#include "bench/tasks/registry.h"
#include "io/streams/load.h"

namespace etude {
namespace {

/// Returns the texts of the files that a condition names, by the key that names the file.
Result<std::map<std::string, std::string>> NamedTextsOf(const Condition& condition, const TaskKind& kind,
                                                        const SourceTexts& texts) {
  std::map<std::string, std::string> named_texts;
  for (const NamedFile& file : FilesNamedBy(condition, kind)) {
    const auto text = texts.find(file.node->scalar);
    if (text == texts.end())
      return Fail(file.node->place, "the content of the file '{}' is missing", file.node->scalar);
    named_texts[file.key] = text->second;
  }
  return named_texts;
}

/// Returns the YAML mappings of the methods that the task itself runs (not outside methods).
std::vector<Node> NodesInTask(const Scenario& scenario) {
  std::vector<Node> nodes;
  for (const MethodEntry& method : scenario.methods) {
    if (method.RunsInTask()) nodes.push_back(method.node);
  }
  return nodes;
}

/// Makes one task per condition. The task reads its own keys from the condition's mapping; a key that neither the task
/// nor the scenario knows is an error.
Result<std::vector<std::unique_ptr<Task>>> MakeTasks(
    const Scenario& scenario, const std::function<const ClipLibrary&(const Condition&)>& clips_of,
    const SourceTexts& texts, const LabelledStreams* recordings, const ScenarioSetup& setup,
    const OpenOptions& opening) {
  const std::vector<Node> built_in = NodesInTask(scenario);
  const TaskKind& kind = *FindTaskKind(scenario.task);
  std::vector<std::unique_ptr<Task>> tasks;
  for (const Condition& condition : scenario.conditions) {
    Fields fields(condition.node, "a scenario of task " + scenario.task);
    for (const KeyInfo& key : CommonScenarioKeys()) fields.Raw(key.key);
    ASSIGN_OR_RETURN(auto named_texts, NamedTextsOf(condition, kind, texts));
    TaskInput input{fields, built_in, clips_of(condition), std::move(named_texts), recordings, setup.files, &opening};
    ASSIGN_OR_RETURN(auto task, kind.make(input));
    RETURN_IF_ERROR(fields.Finish());
    tasks.push_back(std::move(task));
  }
  return tasks;
}

/// Returns the names of the sampling units to which one world's clips belong, sorted and without duplicates. Empty if
/// every world is its own unit.
std::vector<std::string> UnitsOf(const std::vector<std::string>& clips, SamplingUnit unit, const ClipLibrary& library) {
  if (WorldsAreUnits(unit)) return {};
  if (unit == SamplingUnit::kLibrary) {
    std::set<std::string> collections;
    for (const LibraryClip& clip : library.clips) {
      if (std::ranges::find(clips, clip.name) != clips.end()) collections.insert(CollectionOf(clip));
    }
    return {collections.begin(), collections.end()};
  }
  std::set<std::string> names(clips.begin(), clips.end());
  if (unit == SamplingUnit::kClip && !clips.empty()) names = {clips.front()};
  return {names.begin(), names.end()};
}

/// Returns, for every condition, a name from which its random numbers are derived. In secret worlds, the name contains
/// the swept values, so adding a value to a sweep does not change the random numbers of other conditions. The length of
/// the swept values' text comes before the text, so that no name is the beginning of another.
std::vector<std::string> NameDice(const Scenario& scenario, const Seed& seed) {
  std::vector<std::string> names;
  for (const Condition& condition : scenario.conditions) {
    const std::string label = CompactLabel(condition.swept);
    names.push_back(seed.IsPlain() ? scenario.name : fmt::format("{}/{}:{}", scenario.name, label.size(), label));
  }
  return names;
}

Json EncodeSeed(const Seed& seed) { return seed.IsPlain() ? Json(seed.number()) : Json(ToString(seed)); }

Result<Seed> DecodeSeed(const Json& json, const Place& place) {
  if (!json.is_string()) return Seed(json.get<std::uint64_t>());
  auto seed = ParseSeed(json.get<std::string>());
  if (seed && !seed->IsPlain()) return seed;
  return Fail(place, "'seed' must be a whole number, or 'secret' and a digest, found {}", json.dump());
}

}  // namespace

std::vector<RefusedClip> LeftOutOf(const SuiteSetup& setup) {
  std::vector<RefusedClip> all;
  for (const ScenarioSetup& scenario : setup.scenarios) {
    for (const RefusedClip& one : scenario.refused) {
      if (std::ranges::find(all, one) == all.end()) all.push_back(one);
    }
  }
  return all;
}

Json EncodeSetup(const SuiteSetup& setup) {
  // Encode each scenario: first the keys that every scenario has, then those lists that are not empty.
  Json scenarios = Json::array();
  for (const ScenarioSetup& scenario : setup.scenarios) {
    scenarios.push_back({{"name", scenario.name},
                         {"file", scenario.file},
                         {"seed", EncodeSeed(scenario.seed)},
                         {"trials", scenario.trials},
                         {"clips", scenario.clips},
                         {"joint_map", scenario.joint_map},
                         {"digest", scenario.digest}});
    for (const RefusedClip& one : scenario.refused) {
      scenarios.back()["refused"].push_back({{"clip", one.clip}, {"why", one.why}});
    }
    for (const JudgedFiles& one : scenario.files) {
      scenarios.back()["files"].push_back({{"name", one.name}, {"truth", one.truth}, {"answers", one.answers}});
      if (!one.unit.empty()) scenarios.back()["files"].back()["unit"] = one.unit;
      if (!one.same_as.empty()) scenarios.back()["files"].back()["same_as"] = one.same_as;
    }
    if (scenario.keeps_motions) scenarios.back()["keeps_motions"] = true;
    if (!scenario.streams.empty()) scenarios.back()["streams"] = scenario.streams;
    if (!scenario.labels.empty()) scenarios.back()["labels"] = scenario.labels;
    for (const NamedClips& library : scenario.libraries) {
      scenarios.back()["libraries"].push_back({{"name", library.name}, {"clips", library.clips}});
    }
  }
  // Encode the texts of the scenario files, and the parts that only some suites have.
  Json sources = Json::object();
  for (const auto& [file, text] : setup.sources) sources[file] = text;
  Json json{{"suite", setup.suite},
            {"seed", EncodeSeed(setup.seed)},
            {"scenarios", std::move(scenarios)},
            {"sources", std::move(sources)}};
  if (!setup.seed.IsPlain()) json["secret_worlds"] = setup.secret_worlds;
  if (setup.scored) json["scored"] = {{"method", setup.scored->name}, {"alone", setup.scored->alone}};
  return json;
}

namespace {

Result<int> TrialsOf(const Json& scenario, const Place& place) {
  const Json& trials = scenario.at("trials");
  if (trials.is_number_integer() && trials >= 1 && trials <= kMaxCells) return trials.get<int>();
  return Fail(place, "'trials' must be a whole number from 1 to {}, found {}", kMaxCells, trials.dump());
}

}  // namespace

Result<SuiteSetup> DecodeSetup(const Json& json, const Place& place) {
  SuiteSetup setup;
  try {
    setup.suite = json.at("suite").get<std::string>();
    ASSIGN_OR_RETURN(setup.seed, DecodeSeed(json.at("seed"), place));
    for (const auto& [file, text] : json.at("sources").items()) setup.sources[file] = text.get<std::string>();
    if (json.at("scenarios").empty()) return Fail(place, "contains no scenario");
    // Decode each scenario. Either all seeds are plain, or all are the same secret seed.
    for (const Json& scenario : json.at("scenarios")) {
      ASSIGN_OR_RETURN(const int trials, TrialsOf(scenario, place));
      ASSIGN_OR_RETURN(const Seed seed, DecodeSeed(scenario.at("seed"), place));
      if (!setup.seed.IsPlain() && seed != setup.seed)
        return Fail(place, "one of the scenarios has a different secret seed than the suite");
      if (setup.seed.IsPlain() && !seed.IsPlain())
        return Fail(place, "some of the seeds are secret and others are public");
      setup.scenarios.push_back({scenario.at("file").get<std::string>(), scenario.at("name").get<std::string>(), seed,
                                 trials, scenario.at("clips").get<std::vector<std::string>>(),
                                 scenario.value("joint_map", ""), scenario.at("digest").get<std::string>()});
      setup.scenarios.back().streams = scenario.value("streams", std::vector<std::string>{});
      setup.scenarios.back().labels = scenario.value("labels", std::vector<std::string>{});
      setup.scenarios.back().keeps_motions = scenario.value("keeps_motions", false);
      for (const Json& one : scenario.value("refused", Json::array())) {
        setup.scenarios.back().refused.push_back({one.at("clip").get<std::string>(), one.at("why").get<std::string>()});
      }
      for (const Json& one : scenario.value("files", Json::array())) {
        setup.scenarios.back().files.push_back(
            {one.at("name").get<std::string>(), one.value("unit", ""), one.at("truth").get<std::string>(),
             one.at("answers").get<std::vector<std::string>>(), one.value("same_as", "")});
      }
      for (const Json& library : scenario.value("libraries", Json::array())) {
        setup.scenarios.back().libraries.push_back(
            {library.at("name").get<std::string>(), library.at("clips").get<std::vector<std::string>>()});
      }
    }
    // Decode the parts that only some suites have.
    setup.secret_worlds = json.value("secret_worlds", 1);
    if (json.contains("scored")) {
      const Json& scored = json.at("scored");
      setup.scored = ScoredMethod{scored.at("method").get<std::string>(), scored.at("alone").get<bool>()};
    }
  } catch (const Json::exception& error) {
    return Fail(place, "is not the set-up of a suite: {}", error.what());
  }
  return setup;
}

Result<OpenOptions> OpenOptionsOf(const ScenarioSetup& setup, const SourceTexts& texts) {
  OpenOptions how;
  how.recorded = &MotionsOfRuns();
  if (setup.joint_map.empty()) return how;
  const auto text = texts.find(setup.joint_map);
  if (text == texts.end()) return Fail({setup.file, 0, 0}, "the content of the file '{}' is missing", setup.joint_map);
  ASSIGN_OR_RETURN(auto roles, ReadJointMapFile(text->second, setup.joint_map));
  how.roles = std::move(roles);
  return how;
}

Result<void> FindFiles(const Scenario& scenario, const SourceTexts& texts, ScenarioSetup& setup) {
  const TaskKind& kind = *FindTaskKind(scenario.task);
  if (kind.find_files == nullptr) return {};
  FoundFiles found;
  for (const Condition& condition : scenario.conditions) {
    ASSIGN_OR_RETURN(const auto named_texts, NamedTextsOf(condition, kind, texts));
    ASSIGN_OR_RETURN(auto of_condition, kind.find_files(condition.node, NodesInTask(scenario), named_texts));
    if (!found.worlds.empty() && of_condition.worlds != found.worlds) {
      return Fail(condition.node.place,
                  "in task {}, all conditions must judge the same files; sweep only keys that change the judgement",
                  kind.name);
    }
    found = std::move(of_condition);
  }
  for (auto& [file, why] : found.left_out) setup.refused.push_back({file, why});
  setup.files = std::move(found.worlds);
  if (kind.find_equal_truths != nullptr) {
    ASSIGN_OR_RETURN(const OpenOptions opening, OpenOptionsOf(setup, texts));
    kind.find_equal_truths(setup.files, opening);
  }
  return {};
}

namespace {

/// Loads the recordings from which a scenario's worlds are made. Returns null if the worlds are not made from
/// recordings. Recordings that are left out are added to `refused`, unless it is null.
Result<std::unique_ptr<LabelledStreams>> LoadRecordings(const ScenarioSetup& setup, const StreamSource& source,
                                                        const ClipLibrary& clips, const SourceTexts& texts,
                                                        std::vector<RefusedClip>* refused = nullptr) {
  if (setup.streams.empty() && setup.labels.empty()) return nullptr;
  LabelTexts labels;
  for (const std::string& file : setup.labels) {
    const auto text = texts.find(file);
    if (text == texts.end()) return Fail({setup.file, 0, 0}, "the content of the file '{}' is missing", file);
    labels[file] = text->second;
  }
  std::vector<NamedStream> streams = StreamsOf(clips);
  if (!setup.streams.empty()) {
    ASSIGN_OR_RETURN(const auto how, OpenOptionsOf(setup, texts));
    ASSIGN_OR_RETURN(auto loaded, LoadStreams(setup.streams, source.reading, source.making, how));
    streams = std::move(loaded.streams);
    if (refused != nullptr) {
      for (const Error& error : loaded.refused) refused->push_back({error.place.file, ToString(error)});
    }
    // A stream is sensor data, whatever its format. Remove its motion, so that no simulated sensor adds errors to data
    // that a sensor has already measured.
    for (NamedStream& stream : streams) stream.motion.reset();
  }
  if (streams.empty()) return Fail({setup.file, 0, 0}, "'labels' is allowed only with 'streams' or 'clips'");
  ASSIGN_OR_RETURN(auto labelled, LabelStreams(std::move(streams), labels));
  if (refused != nullptr) {
    for (const Error& copy : labelled.copies) refused->push_back({copy.place.file, copy.message});
  }
  return std::make_unique<LabelledStreams>(std::move(labelled));
}

}  // namespace

bool IsFilmed(const Scenario& scenario) {
  return std::ranges::any_of(scenario.conditions, [](const Condition& condition) {
    const Node* sensor = condition.node.Find(kSensorKey);
    return sensor != nullptr && sensor->scalar == kCameraSensor;
  });
}

bool Draws(const Scenario& scenario) {
  return IsFilmed(scenario) || FindTaskKind(scenario.task)->platform != nullptr;
}

Result<std::optional<int>> CountRecordedPeople(ScenarioSetup& setup, const StreamSource& source,
                                               const SourceTexts& texts) {
  if (setup.streams.empty() && setup.labels.empty()) return std::nullopt;
  ASSIGN_OR_RETURN(const auto how, OpenOptionsOf(setup, texts));
  ASSIGN_OR_RETURN(const auto clips, LoadClips(setup.clips, {setup.file, 0, 0}, how));
  ASSIGN_OR_RETURN(const auto recordings, LoadRecordings(setup, source, clips, texts, &setup.refused));
  return static_cast<int>(recordings->people.size());
}

Result<Scenario> ParsedSuite::Find(const ScenarioSetup& setup) {
  auto file = suite_.parsed.find(setup.file);
  if (file == suite_.parsed.end()) {
    file = parsed_.find(setup.file);
    if (file == parsed_.end()) {
      ASSIGN_OR_RETURN(auto scenarios, ParseScenarios(setup.file, suite_.sources));
      file = parsed_.emplace(setup.file, std::move(scenarios)).first;
    }
  }
  const auto named = std::ranges::find(file->second, setup.name, &Scenario::name);
  if (named == file->second.end()) return Fail({setup.file, 0, 0}, "contains no scenario named '{}'", setup.name);
  Scenario scenario = *named;
  scenario.trials = setup.trials;
  if (setup.keeps_motions) {
    scenario.recordings.methods = MethodNames(scenario);
    scenario.recordings.trials.resize(static_cast<std::size_t>(setup.trials));
    std::iota(scenario.recordings.trials.begin(), scenario.recordings.trials.end(), 0);
  }
  AddLibraries(setup.libraries, scenario);
  return scenario;
}

Result<PreparedScenario> Prepare(const SuiteSetup& suite, const ScenarioSetup& setup, Scenario scenario) {
  PreparedScenario prepared;
  prepared.scenario_ = std::move(scenario);
  ASSIGN_OR_RETURN(const auto how, OpenOptionsOf(setup, suite.sources));
  ASSIGN_OR_RETURN(auto clips, LoadClips(setup.clips, {setup.file, 0, 0}, how));
  for (const NamedClips& library : setup.libraries) {
    ASSIGN_OR_RETURN(auto own, LoadClips(library.clips, {setup.file, 0, 0}, how));
    clips.clips.insert(clips.clips.end(), own.clips.begin(), own.clips.end());
    prepared.libraries_.emplace(library.name, std::move(own));
  }
  prepared.clips_ = std::make_unique<ClipLibrary>(std::move(clips));
  prepared.setup_ = setup;
  ASSIGN_OR_RETURN(prepared.recordings_,
                   LoadRecordings(setup, prepared.scenario_.streams, *prepared.clips_, suite.sources));
  prepared.opening_ = std::make_unique<OpenOptions>(how);
  const auto clips_of = [&](const Condition& condition) -> const ClipLibrary& { return prepared.ClipsOf(condition); };
  ASSIGN_OR_RETURN(auto tasks, MakeTasks(prepared.scenario_, clips_of, suite.sources, prepared.recordings(), setup,
                                         *prepared.opening_));
  prepared.tasks_ = std::move(tasks);
  prepared.scenario_.unit = SampledUnit(prepared.scenario_, setup);
  prepared.dice_names_ = NameDice(prepared.scenario_, setup.seed);
  if (suite.scored) {
    RETURN_IF_ERROR(AddScoredMethod(*suite.scored, prepared.scenario_));
  }
  return prepared;
}

Result<std::vector<PreparedScenario>> PrepareAll(const SuiteSetup& suite) {
  std::vector<PreparedScenario> scenarios;
  std::size_t cells = 0;
  ParsedSuite parsed(suite);
  for (const ScenarioSetup& setup : suite.scenarios) {
    ASSIGN_OR_RETURN(auto found, parsed.Find(setup));
    ASSIGN_OR_RETURN(auto prepared, Prepare(suite, setup, std::move(found)));
    const Scenario& scenario = prepared.scenario();
    cells += scenario.conditions.size() * scenario.methods.size() * static_cast<std::size_t>(setup.trials);
    if (cells > kMaxCells)
      return Fail({setup.file, 0, 0}, "with this scenario, the run has more than {} cells", kMaxCells);
    scenarios.push_back(std::move(prepared));
  }
  return scenarios;
}

SamplingUnit SampledUnit(const Scenario& scenario, const ScenarioSetup& setup) {
  const bool knows_person = std::ranges::any_of(setup.files, [](const auto& file) { return !file.unit.empty(); });
  return scenario.unit == SamplingUnit::kClip && knows_person ? SamplingUnit::kRecordedPerson : scenario.unit;
}

Result<void> AddScoredMethod(const ScoredMethod& method, Scenario& scenario) {
  if (!IsPlainName(method.name)) {
    return Fail(
        {},
        "'{}' is not a valid method name; allowed: letters, digits, '_' and, after the first, '-' and '.'; at most 80",
        method.name);
  }
  std::vector<MethodEntry>& methods = scenario.methods;
  if (method.alone) {
    methods.clear();
    scenario.expectations.clear();
    scenario.gate = {};
    scenario.recordings.methods.clear();
  }
  const auto has_its_name = [&](const MethodEntry& other) { return other.name == method.name; };
  if (std::any_of(methods.begin(), methods.end(), has_its_name)) {
    return Fail({scenario.file, 0, 0}, "scenario {} already has a method with the name '{}'", scenario.name,
                method.name);
  }
  MethodEntry entry;
  entry.name = method.name;
  entry.against = methods.empty() ? method.name : methods.front().name;
  methods.push_back(std::move(entry));
  if (!scenario.recordings.trials.empty()) scenario.recordings.methods.push_back(method.name);
  return {};
}

Row PreparedScenario::IdentityOf(int condition, int trial, std::size_t method) const {
  const std::vector<std::string> clips = tasks_[condition]->ClipsOf(KeyOf(condition, trial));
  Row row;
  row.scenario = scenario_.name;
  row.task = scenario_.task;
  row.condition = scenario_.conditions[condition].swept;
  row.trial = trial;
  if (!clips.empty()) row.clip = clips.front();
  row.units = UnitsOf(clips, scenario_.unit, ClipsOf(scenario_.conditions[condition]));
  if (scenario_.unit == SamplingUnit::kRecordedPerson) row.units = {setup_.files[trial].unit};
  const bool is_copy = !setup_.files.empty() && !setup_.files[trial].same_as.empty();
  if (scenario_.unit == SamplingUnit::kClip && is_copy) row.units = {setup_.files[trial].same_as};
  row.method = scenario_.methods[method].name;
  return row;
}

Row PreparedScenario::EndedRow(int condition, int trial, std::size_t method, Status status,
                               const std::string& reason) const {
  Row row = IdentityOf(condition, trial, method);
  row.result = CellResult::Ended(status, reason);
  CompleteMetrics(condition, row);
  return row;
}

void PreparedScenario::CompleteMetrics(int condition, Row& row) const {
  CellResult& result = row.result;
  if (result.status == Status::kOk) return;
  for (const std::string& id : MetricsOf(*FindTaskKind(scenario_.task), scenario_)) {
    const bool reported = std::any_of(result.metrics.begin(), result.metrics.end(),
                                      [&](const MetricValue& metric) { return metric.id == id; });
    if (reported) continue;
    std::optional<double> value;
    if (result.status != Status::kSkipped) value = tasks_[condition]->ValueOfFailure(id);
    if (value) {
      result.Measure(id, *value);
    } else {
      result.Missing(id, result.reason);
    }
  }
}

}  // namespace etude
