#include "bench/run/dry_run.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "bench/run/cell_runner.h"
#include "bench/run/plan.h"
#include "bench/run/suite.h"
#include "bench/run/supervisor.h"
#include "bench/scenario/scenario.h"
#include "bench/scenario/study_of.h"
#include "bench/statistics/answers.h"
#include "bench/statistics/bootstrap.h"
#include "bench/statistics/compare.h"
#include "bench/statistics/scenario_table.h"
#include "bench/statistics/summary.h"
#include "bench/tasks/registry.h"
#include "engine/base/order_statistics.h"
#include "io/clips/references.h"
#include "io/process/clock.h"

namespace etude {
namespace {

int CountUnitsOf(const PreparedScenario& prepared) {
  const Scenario& scenario = prepared.scenario();
  if (WorldsAreUnits(scenario.unit)) return scenario.trials;
  std::set<std::string> units;
  for (int trial = 0; trial < scenario.trials; ++trial) {
    const Row row = prepared.IdentityOf(0, trial, 0);
    units.insert(row.units.begin(), row.units.end());
  }
  return static_cast<int>(units.size());
}

/// Returns the step between the conditions on which costs are measured: condition c is followed by condition (c + step)
/// modulo `conditions`. Every condition is reached, in an order without a trend. Costs change along a sweep, so the
/// first conditions of the sweep alone would give a biased mean.
int StepOver(int conditions) {
  constexpr double kGolden = 0.618;
  int step = std::max(1, static_cast<int>(std::lround(kGolden * conditions)));
  while (std::gcd(step, conditions) != 1) ++step;
  return step;
}

/// Returns true if no option of the command line replaces the clips or recordings of the scenario file, or changes how
/// they are read.
bool IsAsShipped(const RunOptions& options) {
  return options.clips.empty() && options.libraries.empty() && options.streams.empty() && options.labels.empty() &&
         options.joint_map.empty() && options.clip_facts.empty() && options.from.empty();
}

/// Returns true if every reference names existing clips that come with the program or with a package.
bool AreInstalled(const std::vector<std::string>& references, const Place& place) {
  return std::ranges::all_of(references, [&](const std::string& one) {
    return (one.starts_with("builtin:") || one.starts_with("assimp:")) && ExpandReference(one, place);
  });
}

/// Returns true if the cost of a scenario can be forecast without loading its input. Everything that the scenario names
/// must come with the program or with a package, so that the input is as valid as when the stored cost was measured.
/// The number of sampling units must be known.
bool IsKnown(const Scenario& scenario, const ScenarioSetup& setup, const KeptCost& cost) {
  const bool names_no_file = setup.streams.empty() && setup.labels.empty() && setup.files.empty() &&
                             ProgramsIn(scenario).empty() &&
                             std::ranges::all_of(scenario.conditions, [&](const Condition& condition) {
                               return FilesNamedBy(condition, *FindTaskKind(scenario.task)).empty();
                             });
  const bool has_clips = std::ranges::all_of(
      setup.libraries, [&](const NamedClips& library) { return AreInstalled(library.clips, {setup.file}); });
  return names_no_file && has_clips && AreInstalled(setup.clips, {setup.file}) &&
         (WorldsAreUnits(scenario.unit) || cost.UnitsOf(setup.trials, setup.seed));
}

/// Computes ScenarioForecast::spread, the standard deviation of paired differences, from the cells in a table.
double SpreadOf(const Study& study, const ScenarioTable& table, const std::string& metric) {
  const auto asked = std::ranges::find_if(study.methods, [](const auto& one) { return one.name != one.against; });
  if (asked == study.methods.end()) return 0;
  std::vector<double> deviations;
  for (const ConditionTable& condition : table.conditions()) {
    const std::vector<Pair> pairs = PairsOf(condition, asked->against, asked->name, metric).pairs;
    if (std::ssize(pairs) < kMinSample) continue;
    double mean = 0, squares = 0;
    for (const Pair& pair : pairs) mean += (pair.method - pair.baseline) / static_cast<double>(pairs.size());
    for (const Pair& pair : pairs) squares += std::pow(pair.method - pair.baseline - mean, 2);
    deviations.push_back(std::sqrt(squares / static_cast<double>(pairs.size() - 1)));
  }
  return deviations.empty() ? 0 : Quantile(deviations, 0.5);
}

/// Runs at least one world, and further worlds until all are done or `until` seconds have passed since `start`. Returns
/// the mean time of a world, seconds, and adds the worlds' cells to `table`. The first world includes one-time costs,
/// so the mean leaves it out if other worlds were run.
double MeasureSecondsPerWorld(const PreparedScenario& prepared, const Fence& fence, double until,
                              Clock::time_point start, ScenarioTable& table) {
  const Scenario& scenario = prepared.scenario();
  const int conditions = static_cast<int>(scenario.conditions.size());
  const int step = StepOver(conditions), worlds = conditions * scenario.trials;
  CellRunner runner(prepared, "", fence);
  double first = 0, others = 0;
  int world = 0;
  do {
    const auto began = Clock::now();
    const int condition = world * step % conditions;
    runner.Open(condition, world / conditions);
    for (std::size_t method = 0; method < scenario.methods.size(); ++method) {
      FinishedCell cell = runner.Run(method);
      if (!cell.is_measured) cell = runner.Measure(condition, std::move(cell));
      table.Add(cell.row);
    }
    (world == 0 ? first : others) += SecondsSince(began);
    ++world;
  } while (world < worlds && SecondsSince(start) < until);
  return world == 1 ? first : others / (world - 1);
}

/// Replaces a secret key by another one, so that the outside programs that a dry run starts learn nothing about the
/// worlds of the real run.
void ThrowOtherDice(SuiteSetup& suite) {
  constexpr Words256 kDryRun = {0x0064'7279'2d72'756e};
  suite.seed = Seed::Secret(Encrypt(suite.seed.key(), kDryRun));
  for (ScenarioSetup& scenario : suite.scenarios) scenario.seed = suite.seed;
}

/// Returns how many of `count` worlds, the first of which has number `first` in the plan, belong to the shard.
std::size_t CountIn(const Shard& shard, std::size_t first, std::size_t count) {
  const auto before = [&](std::size_t end) {  // counts the shard's worlds with numbers below `end`
    const auto step = static_cast<std::size_t>(shard.count), offset = static_cast<std::size_t>(shard.index - 1);
    return end <= offset ? 0 : (end - offset - 1) / step + 1;
  };
  return before(first + count) - before(first);
}

}  // namespace

Result<Forecast> DryRun(const RunOptions& options, double sample_seconds) {
  // Check all input as a run does. A scenario of known cost (IsKnown) needs no check, because its input was valid when
  // the cost was measured.
  ASSIGN_OR_RETURN(auto suite, ReadSuiteToRun(options));
  if (!suite.seed.IsPlain()) ThrowOtherDice(suite);
  std::vector<RefusedClip> refused = LeftOutOf(suite);
  ASSIGN_OR_RETURN(const auto kept, ReadKeptCosts());
  std::vector<ScenarioForecast> told;
  std::vector<Study> studies;
  std::vector<const KeptCost*> costs;
  // Index of each scenario among the prepared scenarios; nullopt if it was not prepared.
  std::vector<std::optional<std::size_t>> prepared_at;
  std::vector<ScenarioSetup> unknown;
  for (ParsedSuite parsed(suite); const ScenarioSetup& setup : suite.scenarios) {
    ASSIGN_OR_RETURN(const Scenario scenario, parsed.Find(setup));
    told.push_back({.name = scenario.name,
                    .task = scenario.task,
                    .worlds = static_cast<std::size_t>(scenario.trials),
                    .conditions = scenario.conditions.size(),
                    .methods = scenario.methods.size(),
                    .work = WorkOf(scenario),
                    .unit = scenario.unit,
                    .units = scenario.trials});
    studies.push_back(StudyOf(scenario));
    const auto cost = kept.find(told.back().work);
    costs.push_back(cost != kept.end() && IsAsShipped(options) ? &cost->second : nullptr);
    const bool is_known = costs.back() != nullptr && IsKnown(scenario, setup, *costs.back());
    prepared_at.push_back(is_known ? std::nullopt : std::optional(unknown.size()));
    if (!is_known) unknown.push_back(setup);
    if (is_known && !WorldsAreUnits(scenario.unit)) {
      told.back().units = *costs.back()->UnitsOf(scenario.trials, setup.seed);
    }
  }
  suite.scenarios = std::move(unknown);
  suite.parsed.clear();
  ASSIGN_OR_RETURN(const auto prepared, PrepareToRun(suite, options));
  Forecast forecast{.scenarios = {}, .workers = WorkerCount(options.jobs), .pace = {}};
  ASSIGN_OR_RETURN(const Fence fence, FenceFor(prepared, options.outside, "", options.key));
  Json programs;
  RETURN_IF_ERROR(AddPrograms(prepared, fence, programs));  // fails, as the run would, if a program cannot start
  // Measure the speed of this machine. Stored costs are counted in yardsticks (a fixed amount of arithmetic); the speed
  // converts them to seconds.
  ASSIGN_OR_RETURN(forecast.pace, MeasurePace(forecast.workers));
  // Wall time of a yardstick on one worker.
  const double seconds_per_yardstick = forecast.workers / forecast.pace.yardsticks_per_s;
  const auto start = Clock::now();
  double total = 0;
  std::size_t first_world = 0, measured = 0;
  for (std::size_t i = 0; i < told.size(); ++i) {
    ScenarioForecast& one = told[i];
    const PreparedScenario* const own = prepared_at[i] ? &prepared[*prepared_at[i]] : nullptr;
    if (own != nullptr) one.units = CountUnitsOf(*own);
    const Study& study = studies[i];
    one.is_kept = costs[i] != nullptr;
    one.metric = ValueMetricOf(study).empty() ? study.success : ValueMetricOf(study);
    // Count the scenario's worlds in the shard.
    const std::size_t all = one.conditions * one.worlds, in_shard = CountIn(options.shard, first_world, all);
    first_world += all;
    forecast.cells += in_shard * one.methods;
    // Find the cost per world and the spread of differences: use stored values, or measure them.
    const auto worlds = static_cast<double>(in_shard);
    if (one.is_kept) {
      if (worlds > 0) total += seconds_per_yardstick * costs[i]->once;
      one.seconds_per_world = seconds_per_yardstick * costs[i]->trial / static_cast<double>(one.conditions);
      one.spread = costs[i]->spread;
    } else {
      const auto unmeasured = static_cast<double>(std::ranges::count(costs, nullptr));
      const double until = sample_seconds * static_cast<double>(++measured) / unmeasured;
      ScenarioTable table(study);
      one.seconds_per_world = MeasureSecondsPerWorld(*own, fence, until, start, table);
      one.spread = SpreadOf(study, table, one.metric);
    }
    one.comparisons = CountComparisons(study);
    one.needed = WorldsNeeded(study);
    total += one.seconds_per_world * worlds;
    forecast.scenarios.push_back(std::move(one));
  }
  forecast.refused = std::move(refused);
  forecast.seconds = total / forecast.workers;
  return forecast;
}

}  // namespace etude
