#include "reports/viewer/recorded_worlds.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "io/drawing/escape.h"
#include "io/files/json.h"
#include "reports/words/figures.h"
#include "reports/words/judged.h"

namespace etude {

std::string RecordedWorld::Name() const {
  const Row& row = *cells.front().row;
  const std::string condition = ConditionLabel(row.condition);
  const std::string world = JudgesFiles(row.task) ? row.clip : fmt::format("trial {}", row.trial);
  return condition.empty() ? world : condition + ", " + world;
}

std::vector<RecordedWorld> RecordedWorlds(const RunData& run) {
  std::map<std::string_view, const Recording*> recordings;
  // Find the recordings that hold motions.
  for (const CellRecording& recorded : run.recordings) {
    const std::vector<Track>& tracks = recorded.recording.tracks;
    const bool moves = std::ranges::any_of(tracks, [](const Track& track) { return !track.motion.poses.empty(); });
    // A recording without tracks has its motions in the extras (EvaluationExtras).
    if (moves || tracks.empty()) recordings.emplace(recorded.cell, &recorded.recording);
  }
  std::vector<RecordedWorld> worlds;
  if (recordings.empty()) return worlds;
  // Group the cells with recordings by world.
  std::map<std::string, std::size_t> index_of;  // indices into `worlds`
  for (const Row& row : run.rows) {
    const auto recorded = recordings.find(row.Id());
    const auto scenario = std::ranges::find(run.scenarios, row.scenario, &ScenarioSummary::name);
    if (recorded == recordings.end() || scenario == run.scenarios.end()) continue;
    const std::string world = fmt::format("{}/{}/{}", row.scenario, CompactLabel(row.condition), row.trial);
    const auto [entry, is_new] = index_of.emplace(world, worlds.size());
    if (is_new) {
      const auto index = static_cast<std::size_t>(scenario - run.scenarios.begin());
      const auto before = std::ranges::count(worlds, index, &RecordedWorld::scenario);
      worlds.push_back({.scenario = index,
                        .file = fmt::format("motions/{}-{}.js", FileNameOf(scenario->name, index), before + 1),
                        .cells = {}});
    }
    worlds[entry->second].cells.push_back({&row, recorded->second});
  }
  // Order the cells of each world by method.
  for (RecordedWorld& world : worlds) {
    std::ranges::stable_sort(world.cells, {}, [&](const RecordedCell& cell) {
      return IndexOf(run.scenarios[world.scenario], cell.row->method);
    });
  }
  return worlds;
}

std::string ViewerIndexHtml(const RunData& run) {
  Json files = Json::object();
  for (const RecordedWorld& world : RecordedWorlds(run)) {
    for (const RecordedCell& cell : world.cells) files[world.file].push_back(cell.row->Id());
  }
  if (files.empty()) return "";
  return fmt::format("<script type=\"application/json\" id=\"motions\">{}</script>",
                     EscapeScriptJson(files.dump(-1, ' ', false, Json::error_handler_t::replace)));
}

std::string WatchHtml(const RunData& run, std::size_t scenario) {
  std::vector<RecordedWorld> worlds = RecordedWorlds(run);
  std::erase_if(worlds, [&](const RecordedWorld& world) { return world.scenario != scenario; });
  // If all worlds have the same trial number, name the worlds by their conditions only.
  const bool one_trial = worlds.size() > 1 && std::ranges::all_of(worlds, [&](const RecordedWorld& world) {
                           return world.cells.front().row->trial == worlds.front().cells.front().row->trial;
                         });
  std::string html;
  for (const RecordedWorld& world : std::span(worlds).first(std::min(worlds.size(), kMaxListed))) {
    html += fmt::format(" <button type=\"button\" data-cell=\"{}\">{}</button>",
                        EscapeMarkup(world.cells.front().row->Id()),
                        EscapeMarkup(one_trial ? ConditionLabel(world.cells.front().row->condition) : world.Name()));
  }
  if (html.empty()) return "";
  return fmt::format("<p class=\"watch\" hidden>Motions:{}</p>{}", html,
                     LeftOutHtml(worlds.size(), kMaxListed, "recorded worlds", "report/motions"));
}

}  // namespace etude
