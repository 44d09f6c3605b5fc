#include "reports/films/ik_race.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "bench/files/json.h"
#include "bench/model/recording.h"
#include "reports/films/cast.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

/// A cell and what it recorded.
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

/// In the run's order: by condition, trial, method.
std::vector<RecordedCell> RecordedCells(const RunData& run, const ScenarioSummary& scenario) {
  std::vector<RecordedCell> cells;
  for (const Row& row : run.rows) {
    if (row.scenario != scenario.name) continue;
    const auto found = std::ranges::find(run.recordings, row.Id(), &CellRecording::cell);
    if (found != run.recordings.end()) cells.push_back({&row, &found->recording});
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

/// Whole numbers from 0 on that never fall.
bool RisesFromZero(const std::vector<double>& values) {
  constexpr double kMost = 1e9;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool follows = i == 0 ? values[i] == 0 : values[i] >= values[i - 1];
    if (!follows || values[i] != std::floor(values[i]) || values[i] > kMost) return false;
  }
  return true;
}

/// Numbers of zero or more, `count` of them.
Result<std::vector<double>> ReadNumbers(const Json& extras, const char* key, std::size_t count, const Place& place) {
  std::vector<double> values;
  const Json list = extras.value(key, Json());
  for (const Json& value : list) {
    if (!value.is_number() || value.get<double>() < 0) break;
    values.push_back(value.get<double>());
  }
  if (!list.is_array() || values.size() != count || list.size() != count) {
    return Fail(place, "its extras' {} is no list of {} numbers of at least 0, one per pose", key, count);
  }
  return values;
}

Result<IkTargets> ReadTargets(const Row& row, const Recording& recording) {
  const Json list = Json::parse(recording.extras_json, nullptr, false).value("targets_m", Json());
  const auto is_place = [](const Json& place) {
    return place.is_null() || (place.is_array() && place.size() == 3 &&
                               std::ranges::all_of(place, [](const Json& number) { return number.is_number(); }));
  };
  IkTargets targets;
  if (!list.is_array() || list.size() != targets.size() || !std::ranges::all_of(list, is_place)) {
    return Fail({.file = "recording " + row.Id()}, "its extras' targets_m is no list of {} places", targets.size());
  }
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (!list[i].is_null()) targets[i] = glm::dvec3(list[i][0], list[i][1], list[i][2]);
  }
  return targets;
}

std::optional<int> FindSolved(const IkPath& path) {
  std::optional<int> since;
  for (std::size_t i = path.poses.size(); i-- > 0;) {
    if (path.position_cm[i] >= kGoalCm || path.orientation_deg[i] >= kGoalDeg) break;
    since = path.iterations[i];
  }
  return since;
}

Result<IkPath> ReadPath(const Row& row, const Recording& recording) {
  const Place place{.file = "recording " + row.Id()};
  const BodyMotion* motion = FindTrack(recording, "solution");
  if (motion == nullptr || motion->poses.empty()) return Fail(place, "it lacks the track solution");
  const Json extras = Json::parse(recording.extras_json, nullptr, false);
  if (!extras.is_object()) return Fail(place, "its extras are no JSON object");
  const std::size_t count = motion->poses.size();
  auto iterations = ReadNumbers(extras, "iterations", count, place);
  auto position = ReadNumbers(extras, "position_error_max_cm", count, place);
  auto orientation = ReadNumbers(extras, "axis_error_max_deg", count, place);
  for (const auto* list : {&iterations, &position, &orientation}) {
    if (!*list) return tl::unexpected(list->error());
  }
  if (!RisesFromZero(*iterations)) return Fail(place, "its extras' iterations are no whole numbers rising from 0");

  IkPath path;
  path.method = row.method;
  path.poses = motion->poses;
  path.iterations.assign(iterations->begin(), iterations->end());
  path.position_cm = std::move(*position);
  path.orientation_deg = std::move(*orientation);
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
    return Fail({.file = "recording " + cells[0].row->Id()}, "it lacks the track truth");
  }
  race.truth = truth->poses.front();
  for (std::size_t i = 0; i < 2; ++i) {
    ASSIGN_OR_RETURN(auto path, ReadPath(*cells[i].row, *cells[i].recording));
    race.paths[i] = std::move(path);
  }
  ASSIGN_OR_RETURN(auto targets, ReadTargets(*cells[0].row, *cells[0].recording));
  race.targets = targets;
  return race;
}

/// Why this world cannot be shown: "trial 3 (adaptive: crashed)".
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
  if (methods.empty()) return Fail(nowhere, "this run kept no recordings here (the scenario's key video)");
  if (methods.size() == 1) {
    return Fail(nowhere, "this run kept recordings of one method only here; two in the same world are needed");
  }
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
    for (IkPath& path : race->paths) {
      path.method_index =
          static_cast<std::size_t>(std::ranges::find(scenario.methods, path.method) - scenario.methods.begin());
    }
    race->choice = "the first world that kept recordings of both";
    if (!passed_over.empty()) {
      race->choice += fmt::format("; before it, {} had one of them only, the first: {}",
                                  Plural(static_cast<long long>(passed_over.size()), "world"), passed_over.front());
    }
    return race;
  }
  return Fail(nowhere, "no world kept recordings of both {} and {}", methods[0], methods[1]);
}

}  // namespace etude
