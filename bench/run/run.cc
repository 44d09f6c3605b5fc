#include "bench/run/run.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
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

constexpr std::size_t kMostCells = 10'000'000;  // their rows are held in memory

double SecondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::string SuiteName(const std::vector<std::string>& paths) {
  if (paths.size() != 1) return "suite";
  const fs::path path = fs::path(paths.front()).lexically_normal();
  std::error_code error;
  if (!fs::is_directory(path, error)) return path.stem().string();
  const std::string name = (path.has_filename() ? path : path.parent_path()).filename().string();
  return name.empty() || name == "." ? "suite" : name;
}

Result<SuiteSetup> ReadSuite(const RunOptions& options) {
  const auto files = FindScenarioFiles(options.scenarios);
  if (!files) return tl::unexpected(files.error());
  SuiteSetup suite;
  suite.suite = SuiteName(options.scenarios);
  suite.seed = options.seed.value_or(1);
  std::map<std::string, std::string> file_of_name;
  std::size_t cells = 0;
  for (const std::string& file : *files) {
    auto text = ReadWholeFile(file);
    if (!text) return tl::unexpected(text.error());
    const auto scenario = ParseScenario(*text, file);
    if (!scenario) return tl::unexpected(scenario.error());
    const auto [other, is_new] = file_of_name.emplace(scenario->name, file);
    if (!is_new) {
      return Fail({file, 0, 0}, "a scenario named '{}' stands in {} already", scenario->name, other->second);
    }
    const int trials = options.trials.value_or(scenario->trials);
    cells += scenario->conditions.size() * scenario->methods.size() * static_cast<std::size_t>(trials);
    if (cells > kMostCells) {
      return Fail({file, 0, 0}, "{} conditions × {} methods × {} trials make more than {} cells in one run",
                  scenario->conditions.size(), scenario->methods.size(), trials, kMostCells);
    }
    const bool replaced = !options.clips.empty() && !scenario->clips.empty();
    suite.scenarios.push_back({file, std::move(*text), options.seed ? *options.seed : scenario->seed.value_or(1),
                               trials, replaced ? options.clips : scenario->clips});
  }
  return suite;
}

/// The name of a part of a result folder, or of one that was being written.
bool IsPartOfRun(const fs::path& name) {
  static const std::vector<std::string> parts = {"manifest.json", "host.json", kJournalFile, "cells.jsonl",
                                                 "timings.jsonl", "series",    "recordings", "summary.json",
                                                 "report",        "video"};
  return std::any_of(parts.begin(), parts.end(),
                     [&](const std::string& part) { return name == part || name == TemporaryName(part); });
}

/// The folder to write into. One that holds anything is left alone, unless it is a run to be replaced.
Result<fs::path> ChooseFolder(const RunOptions& options, const SuiteSetup& suite) {
  const fs::path folder = options.output.empty() ? fs::path("out") / fmt::format("{}-{}", suite.suite, suite.seed)
                                                 : fs::path(options.output);
  const Place place{folder.string(), 0, 0};
  std::error_code error;
  if (!fs::exists(folder, error)) return folder;
  if (!fs::is_directory(folder, error)) return Fail(place, "is no folder");
  bool holds_run = false;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path name = entry->path().filename();
    if (!IsPartOfRun(name)) {
      return Fail(place, "holds something that is no run ('{}'); choose another folder with -o", name.string());
    }
    holds_run = true;
  }
  if (error) return Fail(place, "cannot be read: {}", error.message());
  if (!holds_run) return folder;
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

/// A result folder that this run alone writes into, emptied of an older run. One that ends before any
/// world did takes the folder away again, if it made it.
class RunFolder {
 public:
  static Result<RunFolder> Claim(const fs::path& path) {
    const Place place{path.string(), 0, 0};
    std::error_code error;
    const bool made = !fs::exists(path, error);
    fs::create_directories(path, error);
    if (error) return Fail(place, "cannot be made: {}", error.message());
    RunFolder folder(path, made, ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (::flock(folder.lock_, LOCK_EX | LOCK_NB) != 0) {
      folder.is_ours_ = false;
      return Fail(place, "another run is writing into it; choose another folder with -o");
    }
    for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
      fs::remove_all(entry->path(), error);
      if (error) break;
    }
    if (error) return Fail(place, "cannot be emptied: {}", error.message());
    return folder;
  }

  RunFolder(RunFolder&& other) noexcept
      : path_(std::move(other.path_)),
        is_ours_(std::exchange(other.is_ours_, false)),
        lock_(std::exchange(other.lock_, -1)) {}
  ~RunFolder() {
    std::error_code ignored;
    if (is_ours_) fs::remove_all(path_, ignored);
    if (lock_ >= 0) ::close(lock_);
  }

  /// From now on there is something in it worth keeping.
  void Keep() { is_ours_ = false; }

 private:
  RunFolder(fs::path path, bool made, int lock) : path_(std::move(path)), is_ours_(made), lock_(lock) {}

  fs::path path_;
  bool is_ours_;  ///< made by this run, and nothing in it yet that is worth keeping
  int lock_;      ///< the lock ends with the process, however that ends
};

/// The append-only record of a run that is under way.
class Journal {
 public:
  explicit Journal(const fs::path& folder) : path_(folder / kJournalFile), out_(path_, std::ios::binary) {}

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
    std::error_code ignored;
    fs::remove(path_, ignored);
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
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status)) {
      std::vector<std::string> inside;
      for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
        if (entry->path().extension() == ".yaml") inside.push_back(entry->path().string());
      }
      if (error) return Fail({path, 0, 0}, "cannot be read: {}", error.message());
      if (inside.empty()) return Fail({path, 0, 0}, "holds no scenario (*.yaml)");
      std::sort(inside.begin(), inside.end());
      files.insert(files.end(), inside.begin(), inside.end());
    } else if (status.type() == fs::file_type::not_found) {
      return Fail({path, 0, 0}, "no such scenario file or folder");
    } else {
      files.push_back(path);  // reading it tells what else is wrong with it
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

  if (options.stop != nullptr && *options.stop) return RunOutcome{.folder = *folder, .stopped = true};
  auto claimed = RunFolder::Claim(*folder);
  if (!claimed) return tl::unexpected(claimed.error());
  auto saved = SaveJson(*folder / "manifest.json", Manifest(*suite, *scenarios, options.program_version));
  if (!saved) return tl::unexpected(saved.error());
  Journal journal(*folder);

  Progress progress{.worlds = worlds.size()};
  on_progress(progress);
  std::vector<WorldAnswer> answers(worlds.size());
  const auto deliver = [&](WorldAnswer answer) -> Result<void> {
    if (auto kept = journal.Append(answer); !kept) return kept;
    claimed->Keep();
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
  if (!whole) {
    Error failure = whole.error();
    if (progress.worlds_done > 0) failure.message += fmt::format("; {} is kept", (*folder / kJournalFile).string());
    return tl::unexpected(std::move(failure));
  }
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
