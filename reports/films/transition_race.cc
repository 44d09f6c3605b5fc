#include "reports/films/transition_race.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "bench/metrics/transition_smoothness.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

// Older recordings tell the wait only; what tells neither is aligned at its switch.
int RequestOf(const SwitchFacts& facts, double rate_hz) {
  if (facts.request_frame) return *facts.request_frame;
  constexpr double kLongest = 3600;
  const double wait = std::clamp(facts.wait_s.value_or(0), 0.0, kLongest);
  return facts.seam_frames.back() - static_cast<int>(std::lround(wait * rate_hz));
}

bool CanBeShown(const RecordedSwitch& recorded) {
  return recorded.row->result.status == Status::kOk && !recorded.facts.seam_frames.empty();
}

std::vector<const RecordedSwitch*> ShownOf(const SwitchWorld& world, const std::vector<std::string>& methods) {
  std::vector<const RecordedSwitch*> shown;
  for (const std::string& method : methods) {
    const auto found = std::ranges::find_if(
        world.switches, [&](const RecordedSwitch& s) { return s.row->method == method && CanBeShown(s); });
    if (found != world.switches.end() && shown.size() < kMostSwitchPaths) shown.push_back(&*found);
  }
  return shown;
}

}  // namespace

int SwitchPath::FrameAt(int time) const {
  return std::clamp(request + time, 0, static_cast<int>(motion.poses.size()) - 1);
}

bool SwitchPath::IsRecordedAt(int time) const { return request + time >= 0; }

std::size_t SwitchPath::SeamsBefore(int time) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(facts.seam_frames, [&](int seam) { return TimeOf(seam) < time; }));
}

Result<SwitchRace> FindSwitchRace(const RunData& run, const ScenarioSummary& scenario) {
  const std::vector<SwitchWorld> worlds = SwitchWorldsOf(run, scenario);
  const SwitchWorld* best = nullptr;
  std::vector<const RecordedSwitch*> shown;
  for (const SwitchWorld& world : worlds) {
    auto candidates = ShownOf(world, scenario.methods);
    if (candidates.size() <= shown.size()) continue;
    best = &world;
    shown = std::move(candidates);
  }
  if (worlds.empty()) {
    return Fail({}, "this run kept no recordings of switches here (the scenario's key video)");
  }
  if (shown.size() < 2) return Fail({}, "no world kept recordings of two methods that switched");
  SwitchRace race{.world = best->Name(), .request = best->Request(), .choice = {}, .paths = {}};
  race.choice = fmt::format("the first of {} recorded in which most of them switched",
                            Plural(static_cast<long long>(worlds.size()), "world"));
  for (const RecordedSwitch* recorded : shown) {
    const BodyMotion& motion = *FindTrack(*recorded->recording, "coach");
    race.paths.push_back({.method = recorded->row->method,
                          .facts = recorded->facts,
                          .motion = motion,
                          .jumps_cm = SecondDifferencesCm(motion),
                          .request = RequestOf(recorded->facts, motion.rate_hz)});
  }
  return race;
}

}  // namespace etude
