#include "reports/films/ik_race.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "bench/model/recording.h"
#include "bench/recordings/task_extras.h"
#include "reports/words/cell_series.h"
#include "reports/words/figures.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

/// A recorded cell: the cell's row and recording.
struct RecordedCell {
  const Row* row;
  const Recording* recording;

  bool SharesWorld(const Row& other) const {
    return row->scenario == other.scenario && row->condition == other.condition && row->trial == other.trial;
  }
  std::string World() const {
    const std::string condition = ConditionLabel(row->condition);
    return fmt::format("{}{}trial {}", condition, condition.empty() ? "" : ", ", row->trial);
  }
};

/// Lists a scenario's recorded cells in the run's order: by condition, trial, method.
std::vector<RecordedCell> RecordedCells(const RunData& run, const ScenarioSummary& scenario) {
  std::vector<RecordedCell> cells;
  const KeptCells kept(run);
  for (const Row& row : run.rows) {
    if (row.scenario != scenario.name) continue;
    const Recording* recording = kept.Find(row.Id());
    if (recording != nullptr) cells.push_back({&row, recording});
  }
  return cells;
}

std::vector<std::string> MethodsOf(const std::vector<RecordedCell>& cells, const ScenarioSummary& scenario) {
  std::vector<std::string> methods;
  std::ranges::copy_if(scenario.methods, std::back_inserter(methods), [&](const std::string& method) {
    return std::ranges::any_of(cells, [&](const RecordedCell& cell) { return cell.row->method == method; });
  });
  return methods;
}

bool AreErrors(const std::vector<double>& values, std::size_t count) {
  return values.size() == count && std::ranges::all_of(values, [](double value) { return value >= 0; });
}

Result<IkExtras> ExtrasOf(const Row& row, const Recording& recording) {
  const Place place{.file = "recording " + row.Id()};
  const BodyMotion* motion = FindTrack(recording, "solution");
  if (motion == nullptr || motion->poses.empty()) return Fail(place, "has no track 'solution'");
  auto extras = ReadExtras<IkExtras>(recording.extras_json);
  if (!extras) return Fail(place, "its extras are {}", extras.error().message);
  const std::size_t count = motion->poses.size();
  const std::vector<int>& iterations = extras->iterations;
  if (iterations.size() != count || iterations.front() != 0 || !std::ranges::is_sorted(iterations)) {
    return Fail(place, "'iterations' in the extras is not a list of {} increasing whole numbers from 0, one per pose",
                count);
  }
  for (const auto& [key, errors] : {std::pair{"position_error_max_cm", &extras->position_error_max_cm},
                                    std::pair{"axis_error_max_deg", &extras->axis_error_max_deg}}) {
    if (AreErrors(*errors, count)) continue;
    return Fail(place, "'{}' in the extras is not a list of {} numbers of at least 0, one per pose", key, count);
  }
  return extras;
}

std::optional<int> FindSolved(const IkPath& path) {
  std::optional<int> since;
  for (std::size_t i = path.poses.size(); i-- > 0;) {
    if (path.position_cm[i] >= kGoalCm || path.orientation_deg[i] >= kGoalDeg) break;
    since = path.iterations[i];
  }
  return since;
}

IkPath PathOf(const Row& row, const Recording& recording, IkExtras extras) {
  IkPath path;
  path.method = row.method;
  path.poses = FindTrack(recording, "solution")->poses;
  path.iterations = std::move(extras.iterations);
  path.position_cm = std::move(extras.position_error_max_cm);
  path.orientation_deg = std::move(extras.axis_error_max_deg);
  if (row.result.status == Status::kOk) {
    path.solved_at = FindSolved(path).value_or(path.iterations.back());
    path.ending = "solved";
  } else {
    path.ending = row.result.status == Status::kUnsolved ? "not solved" : StatusName(row.result.status);
    path.reason = row.result.reason;
  }
  return path;
}

Result<IkRace> MakeRace(const std::array<RecordedCell, 2>& cells) {
  IkRace race;
  race.world = cells[0].World();
  const BodyMotion* truth = FindTrack(*cells[0].recording, "truth");
  if (truth == nullptr || truth->poses.empty()) {
    return Fail({.file = "recording " + cells[0].row->Id()}, "has no track 'truth'");
  }
  race.truth = truth->poses.front();
  // The positions of the targets. Both methods solve the same world, so the targets are the same for both.
  std::vector<std::optional<glm::dvec3>> targets;
  for (std::size_t i = 0; i < 2; ++i) {
    ASSIGN_OR_RETURN(auto extras, ExtrasOf(*cells[i].row, *cells[i].recording));
    if (i == 0) targets = extras.targets_m;
    race.paths[i] = PathOf(*cells[i].row, *cells[i].recording, std::move(extras));
  }
  if (targets.size() != race.targets.size()) {
    return Fail({.file = "recording " + cells[0].row->Id()}, "'targets_m' in the extras is not a list of {} positions",
                race.targets.size());
  }
  std::ranges::copy(targets, race.targets.begin());
  return race;
}

/// Describes a world that cannot be shown, and the reason: "trial 3 (adaptive: crashed)".
std::string WhyPassedOver(const RunData& run, const RecordedCell& cell, const std::string& missing) {
  const auto row = std::ranges::find_if(
      run.rows, [&](const Row& other) { return other.method == missing && cell.SharesWorld(other); });
  return fmt::format("{} ({}: {})", cell.World(), missing,
                     row == run.rows.end() ? "not run" : StatusName(row->result.status));
}

}  // namespace

std::size_t IkPath::EntryAt(double iteration) const {
  const auto after = std::ranges::upper_bound(iterations, iteration);
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - iterations.begin() - 1, 0));
}

bool IsAskedFor(const std::vector<double>& errors) {
  return std::ranges::any_of(errors, [](double error) { return error > 0; });
}

int IkRace::LastIteration() const { return std::max(paths[0].iterations.back(), paths[1].iterations.back()); }

Result<IkRace> FindIkRace(const RunData& run, const ScenarioSummary& scenario) {
  const Place nowhere;
  const std::vector<RecordedCell> cells = RecordedCells(run, scenario);
  const std::vector<std::string> methods = MethodsOf(cells, scenario);
  // Check that two methods have recordings.
  if (methods.empty())
    return Fail(nowhere,
                "this run kept no recordings of this scenario (the scenario key 'video' selects cells to record)");
  if (methods.size() == 1) {
    return Fail(
        nowhere,
        "this run kept recordings of only one method; the film needs recordings of two methods in the same world");
  }
  // Find the first world that both methods recorded, and note the earlier worlds that only one of the two methods
  // recorded.
  std::vector<std::string> passed_over;
  for (const RecordedCell& cell : cells) {
    const bool is_first = cell.row->method == methods[0];
    if (!is_first && cell.row->method != methods[1]) continue;
    const std::string& other = methods[is_first ? 1 : 0];
    const auto partner = std::ranges::find_if(
        cells, [&](const RecordedCell& c) { return c.row->method == other && c.SharesWorld(*cell.row); });
    if (partner == cells.end()) {
      passed_over.push_back(WhyPassedOver(run, cell, other));
      continue;
    }
    auto race = is_first ? MakeRace({cell, *partner}) : MakeRace({*partner, cell});
    if (!race) return race;
    for (IkPath& path : race->paths) path.method_index = IndexOf(scenario, path.method);
    race->choice = "the first world with recordings of both methods";
    if (!passed_over.empty()) {
      race->choice += fmt::format("; before this world, {} had recordings of only one method, the first of them {}",
                                  Plural(static_cast<long long>(passed_over.size()), "world"), passed_over.front());
    }
    return race;
  }
  return Fail(nowhere, "no world has recordings of both {} and {}", methods[0], methods[1]);
}

}  // namespace etude
