#include "bench/run/run.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/files/files.h"
#include "bench/results/folder.h"
#include "bench/run/manifest.h"
#include "bench/run/run_folder.h"
#include "bench/run/suite.h"
#include "bench/statistics/summary.h"

namespace etude {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

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

Result<RunOutcome> Run(const RunOptions& options, const std::function<void(const Progress&)>& on_progress) {
  const auto start = Clock::now();
  const auto suite = ReadSuite(options);
  if (!suite) return tl::unexpected(suite.error());
  const std::string name = fmt::format("out/{}-{}", suite->suite, suite->seed);
  const auto folder = ChooseFolder(options.output.empty() ? name : options.output, options.overwrite);
  if (!folder) return tl::unexpected(folder.error());
  const auto scenarios = PrepareAll(*suite);
  if (!scenarios) return tl::unexpected(scenarios.error());
  const std::vector<World> worlds = AllWorlds(*scenarios);
  const int jobs = options.jobs > 0 ? options.jobs : std::max(1u, std::thread::hardware_concurrency());

  if (options.stop != nullptr && *options.stop) return RunOutcome{.folder = *folder, .stopped = true};
  auto claimed = RunFolder::Claim(*folder);
  if (!claimed) return tl::unexpected(claimed.error());
  auto saved = SaveJson(*folder / "manifest.json", MakeManifest(*suite, *scenarios, options.program_version));
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
  saved = SaveJson(*folder / "host.json", DescribeHost(options.command_line, jobs, outcome.seconds));
  if (!saved) return tl::unexpected(saved.error());
  journal.Remove();
  return outcome;
}

}  // namespace etude
