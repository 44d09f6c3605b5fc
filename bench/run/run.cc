#include "bench/run/run.h"

#include <sys/utsname.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/files/files.h"
#include "bench/results/folder.h"
#include "bench/results/row_json.h"
#include "bench/run/child_process.h"
#include "bench/run/setup.h"
#include "bench/run/supervisor.h"
#include "bench/statistics/summary.h"
#include "engine/base/digest.h"

namespace etude {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::string SuiteName(const std::vector<std::string>& paths) {
  if (paths.size() != 1) return "suite";
  const fs::path path = fs::path(paths.front()).lexically_normal();
  if (!fs::is_directory(path)) return path.stem().string();
  const std::string name = (path.has_filename() ? path : path.parent_path()).filename().string();
  return name.empty() || name == "." ? "suite" : name;
}

Result<SuiteSetup> ReadSuite(const RunOptions& options) {
  const auto files = FindScenarioFiles(options.scenarios);
  if (!files) return tl::unexpected(files.error());
  SuiteSetup suite;
  suite.suite = SuiteName(options.scenarios);
  suite.seed = options.seed.value_or(1);
  for (const std::string& file : *files) {
    auto text = ReadWholeFile(file);
    if (!text) return tl::unexpected(text.error());
    const auto scenario = ParseScenario(*text, file);
    if (!scenario) return tl::unexpected(scenario.error());
    for (const ScenarioSetup& other : suite.scenarios) {
      if (ParseScenario(other.text, other.file)->name != scenario->name) continue;
      return Fail({file, 0, 0}, "a scenario named '{}' stands in {} already", scenario->name, other.file);
    }
    const bool replaced = !options.clips.empty() && !scenario->clips.empty();
    suite.scenarios.push_back({file, std::move(*text), options.seed ? *options.seed : scenario->seed.value_or(1),
                               options.trials.value_or(scenario->trials),
                               replaced ? options.clips : scenario->clips});
  }
  return suite;
}

/// The folder to write into. One that holds anything is left alone, unless it is a run to be replaced.
Result<fs::path> ChooseFolder(const RunOptions& options, const SuiteSetup& suite) {
  const fs::path folder =
      options.output.empty() ? fs::path("out") / fmt::format("{}-{}", suite.suite, suite.seed) : fs::path(options.output);
  const Place place{folder.string(), 0, 0};
  std::error_code error;
  if (!fs::exists(folder, error)) return folder;
  if (!fs::is_directory(folder, error)) return Fail(place, "is no folder");
  if (fs::is_empty(folder, error)) return folder;
  const bool is_run = fs::exists(folder / "manifest.json") || fs::exists(folder / "journal.jsonl");
  if (!is_run) return Fail(place, "holds something that is no run; choose another folder with -o");
  if (!options.overwrite) return Fail(place, "already holds a run; --overwrite replaces it, -o chooses another folder");
  return folder;
}

/// What repeats the run. Its bytes do not depend on how or where it is run.
Json Manifest(const SuiteSetup& suite, std::span<const PreparedScenario> scenarios, const std::string& version) {
  Json json{{"schema", kResultSchema}, {"etude", version}, {"compiler", __VERSION__}};
  json.update(EncodeSetup(suite));
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    Json clips = Json::array();
    for (const LibraryClip& clip : scenarios[s].clips().clips) {
      Digest digest;
      for (const BodyPose& pose : clip.motion.poses) {
        for (const glm::dvec3& joint : pose.joints) digest.Add(joint.x).Add(joint.y).Add(joint.z);
      }
      clips.push_back({{"name", clip.name},
                       {"source", clip.source},
                       {"frames", clip.motion.poses.size()},
                       {"digest", digest.Hex()},
                       {"note", clip.note}});
    }
    json["scenarios"][s]["digest"] = Digest().Add(suite.scenarios[s].text).Hex();
    json["scenarios"][s]["loaded_clips"] = std::move(clips);
  }
  return json;
}

std::string ProcessorName() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

Json Host(const RunOptions& options, int jobs, double seconds) {
  utsname system{};
  ::uname(&system);
  return {{"host", fmt::format("{} × {}, {} {}", std::thread::hardware_concurrency(), ProcessorName(), system.sysname,
                               system.release)},
          {"command_line", options.command_line},
          {"jobs", jobs},
          {"pinned_environment", PinnedEnvironment()},
          {"wall_seconds", seconds}};
}

std::vector<World> AllWorlds(std::span<const PreparedScenario> scenarios) {
  std::vector<World> worlds;
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    const int conditions = static_cast<int>(scenarios[s].scenario().conditions.size());
    for (int c = 0; c < conditions; ++c) {
      for (int t = 0; t < scenarios[s].setup().trials; ++t) worlds.push_back({static_cast<int>(s), c, t});
    }
  }
  return worlds;
}

/// The append-only record of a run that is under way.
class Journal {
 public:
  explicit Journal(const fs::path& folder) : path_(folder / "journal.jsonl"), out_(path_, std::ios::binary) {}

  Result<void> Append(const WorldAnswer& answer) {
    Json rows = Json::array();
    for (const Row& row : answer.rows) rows.push_back(EncodeRow(row));
    const auto line = WriteJson({{"world", answer.world}, {"rows", rows}, {"wall_s", answer.wall_s}});
    if (!line) return tl::unexpected(line.error());
    out_ << *line << '\n' << std::flush;
    if (!out_) return Fail({path_.string(), 0, 0}, "cannot be written (is the disk full?)");
    return {};
  }

  void Remove() {
    out_.close();
    fs::remove(path_);
  }

 private:
  fs::path path_;
  std::ofstream out_;
};

Result<void> SaveJson(const fs::path& path, const Json& json) {
  const auto text = WriteJson(json);
  if (!text) return tl::unexpected(text.error());
  return WriteFileAtomically(path, *text + "\n");
}

Result<void> SaveTimings(const fs::path& folder, std::span<const WorldAnswer> answers) {
  std::string lines;
  for (const WorldAnswer& answer : answers) {
    const Row& row = answer.rows.front();
    const std::string world = row.Id().substr(0, row.Id().rfind('/'));
    const auto line = WriteJson({{"world", world}, {"wall_s", answer.wall_s}, {"cpu_s", answer.cpu_s}});
    if (!line) return tl::unexpected(line.error());
    lines += *line + "\n";
  }
  return WriteFileAtomically(folder / "timings.jsonl", lines);
}

Result<std::vector<PreparedScenario>> PrepareAll(const SuiteSetup& suite) {
  std::vector<PreparedScenario> scenarios;
  for (const ScenarioSetup& setup : suite.scenarios) {
    auto prepared = Prepare(setup);
    if (!prepared) return tl::unexpected(prepared.error());
    scenarios.push_back(std::move(*prepared));
  }
  return scenarios;
}

}  // namespace

Result<std::vector<std::string>> FindScenarioFiles(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    std::error_code error;
    if (fs::is_directory(path, error)) {
      std::vector<std::string> inside;
      for (const auto& entry : fs::directory_iterator(path, error)) {
        if (entry.path().extension() == ".yaml") inside.push_back(entry.path().string());
      }
      if (inside.empty()) return Fail({path, 0, 0}, "holds no scenario (*.yaml)");
      std::sort(inside.begin(), inside.end());
      files.insert(files.end(), inside.begin(), inside.end());
    } else if (fs::is_regular_file(path, error)) {
      files.push_back(path);
    } else {
      return Fail({path, 0, 0}, "no such scenario file or folder");
    }
  }
  return files;
}

Result<RunOutcome> Run(const RunOptions& options, const std::function<void(const Progress&)>& on_progress) {
  const auto start = Clock::now();
  const auto suite = ReadSuite(options);
  if (!suite) return tl::unexpected(suite.error());
  const auto folder = ChooseFolder(options, *suite);
  if (!folder) return tl::unexpected(folder.error());
  const auto scenarios = PrepareAll(*suite);
  if (!scenarios) return tl::unexpected(scenarios.error());
  const std::vector<World> worlds = AllWorlds(*scenarios);
  const int jobs = options.jobs > 0 ? options.jobs : std::max(1u, std::thread::hardware_concurrency());

  std::error_code error;
  fs::remove_all(*folder, error);
  fs::create_directories(*folder, error);
  if (error) return Fail({folder->string(), 0, 0}, "cannot be made: {}", error.message());
  auto saved = SaveJson(*folder / "manifest.json", Manifest(*suite, *scenarios, options.program_version));
  if (!saved) return tl::unexpected(saved.error());
  Journal journal(*folder);

  Progress progress{.worlds = worlds.size()};
  on_progress(progress);
  std::vector<WorldAnswer> answers(worlds.size());
  const auto deliver = [&](WorldAnswer answer) -> Result<void> {
    if (auto kept = journal.Append(answer); !kept) return kept;
    ++progress.worlds_done;
    progress.cells_done += answer.rows.size();
    progress.cells_ok += std::count_if(answer.rows.begin(), answer.rows.end(),
                                       [](const Row& row) { return row.result.status == Status::kOk; });
    progress.seconds = SecondsSince(start);
    on_progress(progress);
    const std::size_t at = answer.world;
    answers[at] = std::move(answer);
    return {};
  };
  const std::string program = fs::read_symlink("/proc/self/exe").string();
  const auto whole = RunWorlds(*suite, *scenarios, worlds, {program, jobs, options.stop}, deliver);
  if (!whole) return tl::unexpected(whole.error());
  RunOutcome outcome{*folder, progress.cells_done, progress.cells_ok, SecondsSince(start), !*whole};
  if (outcome.stopped) return outcome;

  if (auto timed = SaveTimings(*folder, answers); !timed) return tl::unexpected(timed.error());
  std::vector<Row> rows;
  for (WorldAnswer& answer : answers) std::move(answer.rows.begin(), answer.rows.end(), std::back_inserter(rows));
  std::vector<ScenarioSummary> summaries;
  for (std::size_t s = 0, at = 0; s < scenarios->size(); ++s) {
    const Scenario& scenario = (*scenarios)[s].scenario();
    const std::size_t count =
        scenario.conditions.size() * static_cast<std::size_t>(scenario.trials) * scenario.methods.size();
    summaries.push_back(Summarise(scenario, std::span(rows).subspan(at, count), suite->scenarios[s].seed));
    at += count;
  }
  if (auto written = SaveResults(*folder, rows, summaries); !written) return tl::unexpected(written.error());
  outcome.seconds = SecondsSince(start);
  saved = SaveJson(*folder / "host.json", Host(options, jobs, outcome.seconds));
  if (!saved) return tl::unexpected(saved.error());
  journal.Remove();
  return outcome;
}

}  // namespace etude
