#include "bench/run/dry_run.h"

#include <cmath>
#include <numeric>
#include <set>

#include "bench/run/cell_runner.h"
#include "bench/run/costs.h"
#include "bench/run/plan.h"
#include "bench/run/suite.h"
#include "bench/run/supervisor.h"
#include "bench/scenario/scenario.h"
#include "bench/statistics/answers.h"
#include "bench/statistics/bootstrap.h"
#include "bench/statistics/compare.h"
#include "bench/statistics/scenario_table.h"
#include "bench/statistics/summary.h"
#include "engine/base/order_statistics.h"
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

/// Returns a step that visits all conditions in an order without a trend, because costs change along a sweep.
int StepOver(int conditions) {
  constexpr double kGolden = 0.618;
  int step = std::max(1, static_cast<int>(std::lround(kGolden * conditions)));
  while (std::gcd(step, conditions) != 1) ++step;
  return step;
}

/// Returns true if no option of the command line replaces the clips or recordings that the file names.
bool IsAsShipped(const RunOptions& options) {
  return options.clips.empty() && options.libraries.empty() && options.streams.empty() && options.from.empty();
}

/// Returns ScenarioForecast::spread of the cells in a table.
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

/// Returns the mean time of the first worlds, measured until the time is up; their cells go into `table`. The very first
/// world includes one-time costs, so it counts only if there is no other.
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

/// Replaces a secret key, so that the programs that are asked here learn nothing of the real run.
void ThrowOtherDice(SuiteSetup& suite) {
  constexpr Words256 kDryRun = {0x0064'7279'2d72'756e};
  suite.seed = Seed::Secret(Encrypt(suite.seed.key(), kDryRun));
  for (ScenarioSetup& scenario : suite.scenarios) scenario.seed = suite.seed;
}

}  // namespace

Result<Forecast> DryRun(const RunOptions& options, double sample_seconds) {
  // Check all input as a run does.
  ASSIGN_OR_RETURN(auto suite, ReadSuiteToRun(options));
  if (!suite.seed.IsPlain()) ThrowOtherDice(suite);
  ASSIGN_OR_RETURN(const auto scenarios, PrepareToRun(suite, options));
  Forecast forecast{.scenarios = {}, .workers = WorkerCount(options.jobs), .pace = {}};
  ASSIGN_OR_RETURN(const Fence fence, FenceFor(scenarios, options.outside, "", options.key));
  // The kept costs, and the speed of this machine to scale them by.
  ASSIGN_OR_RETURN(const auto kept, ReadKeptCosts());
  ASSIGN_OR_RETURN(forecast.pace, MeasurePace(forecast.workers));
  const double seconds_per_yardstick = forecast.workers / forecast.pace.yardsticks_per_s;  // for one worker
  const auto start = Clock::now();
  // The worlds of the shard, by scenario.
  const Plan plan(scenarios);
  std::vector<std::size_t> worlds_of(scenarios.size());
  for (std::size_t world = 0; world < plan.world_count(); ++world) {
    if (!plan.IsIn(options.shard, world)) continue;
    ++worlds_of[static_cast<std::size_t>(plan.world(world).scenario)];
    forecast.cells += plan.MethodCount(world);
  }
  double total = 0;
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    const Scenario& scenario = scenarios[i].scenario();
    ScenarioForecast one{.name = scenario.name,
                         .task = scenario.task,
                         .worlds = static_cast<std::size_t>(scenario.trials),
                         .conditions = scenario.conditions.size(),
                         .methods = scenario.methods.size(),
                         .work = WorkOf(scenario),
                         .unit = scenario.unit,
                         .units = CountUnitsOf(scenarios[i])};
    const Study study = StudyOf(scenario);
    one.metric = ValueMetricOf(study).empty() ? study.success : ValueMetricOf(study);
    // The cost per world and the spread: kept, or measured.
    const auto worlds = static_cast<double>(worlds_of[i]);
    const auto cost = kept.find(one.work);
    one.is_kept = cost != kept.end() && IsAsShipped(options);
    if (one.is_kept) {
      if (worlds > 0) total += seconds_per_yardstick * cost->second.once;
      one.seconds_per_world = seconds_per_yardstick * cost->second.trial / static_cast<double>(one.conditions);
      one.spread = cost->second.spread;
    } else {
      const double until = sample_seconds * static_cast<double>(i + 1) / static_cast<double>(scenarios.size());
      ScenarioTable table(study);
      one.seconds_per_world = MeasureSecondsPerWorld(scenarios[i], fence, until, start, table);
      one.spread = SpreadOf(study, table, one.metric);
    }
    one.comparisons = CountComparisons(study);
    total += one.seconds_per_world * worlds;
    forecast.scenarios.push_back(std::move(one));
  }
  forecast.seconds = total / forecast.workers;
  return forecast;
}

}  // namespace etude
