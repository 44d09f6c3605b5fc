#include "reports/transitions/recorded_requests.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <utility>

#include "bench/model/recording.h"
#include "engine/base/names.h"

namespace etude {

Result<TransitionFacts> ReadTransitionFacts(const Recording& recording, const std::string& cell) {
  auto facts = ReadExtras<TransitionExtras>(recording.extras_json);
  if (!facts) return Fail({.file = "recording " + cell}, "its extras are {}", facts.error().message);
  const BodyMotion* coach = FindTrack(recording, "coach");
  const int frames = coach == nullptr ? 0 : static_cast<int>(coach->poses.size());
  const auto is_outside = [&](int frame) { return frame < 0 || frame >= frames; };
  std::erase_if(facts->transition_frames, is_outside);
  if (facts->transition_frames.empty() && facts->transition_frame && !is_outside(*facts->transition_frame)) {
    facts->transition_frames.push_back(*facts->transition_frame);
  }
  std::ranges::sort(facts->transition_frames);
  facts->from = ClipInWords(facts->from);
  facts->to = ClipInWords(facts->to);
  for (PointFacts& point : facts->points) {
    point.from = ClipInWords(point.from);
    point.to = ClipInWords(point.to);
  }
  if (facts->points.empty()) {
    facts->points.push_back(
        {.from = facts->from, .to = facts->to, .distance = facts->distance, .partials = facts->partials});
  }
  return facts;
}

std::string ClipInWords(std::string name) {
  constexpr std::string_view kBuiltin = "builtin:";
  if (name.starts_with(kBuiltin)) name.erase(0, kBuiltin.size());
  return WithSpaces(std::move(name));
}

std::string RecordedRequest::Name() const {
  const Row& row = *transitions.front().row;
  const std::string condition = ConditionLabel(row.condition);
  return fmt::format("{}{}trial {}", condition, condition.empty() ? "" : ", ", row.trial);
}

std::string RecordedRequest::Request() const {
  const TransitionFacts& facts = transitions.front().facts;
  return fmt::format("{} → {}", facts.from, facts.to);
}

std::vector<RecordedRequest> RecordedRequestsOf(const RunData& run, const ScenarioSummary& scenario) {
  std::vector<RecordedRequest> worlds;
  if (scenario.task != "transition" || run.recordings.empty()) return worlds;
  std::map<std::string_view, const Recording*> recordings;
  for (const CellRecording& recorded : run.recordings) recordings.emplace(recorded.cell, &recorded.recording);
  std::map<std::pair<std::string, int>, std::size_t> index_of;
  for (const Row& row : run.rows) {
    if (row.scenario != scenario.name) continue;
    const auto found = recordings.find(row.Id());
    if (found == recordings.end() || FindTrack(*found->second, "coach") == nullptr) continue;
    auto facts = ReadTransitionFacts(*found->second, row.Id());
    if (!facts) continue;
    const auto [entry, is_new] = index_of.try_emplace({CompactLabel(row.condition), row.trial}, worlds.size());
    if (is_new) worlds.emplace_back();
    worlds[entry->second].transitions.push_back({&row, found->second, *std::move(facts)});
  }
  const auto order = [&](const RecordedTransition& s) { return std::ranges::find(scenario.methods, s.row->method); };
  for (RecordedRequest& world : worlds) std::ranges::stable_sort(world.transitions, {}, order);
  return worlds;
}

}  // namespace etude
