#include "reports/films/transition_race.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "bench/metrics/transition_smoothness.h"
#include "bench/model/recording.h"
#include "reports/words/figures.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

// Returns the frame of the request. Older recordings do not contain this frame. For older recordings, it is computed as
// the last transition point minus the wait; an unknown wait counts as 0.
int RequestOf(const TransitionFacts& facts, double rate_hz) {
  if (facts.request_frame) return *facts.request_frame;
  constexpr double kMaxWaitSeconds = 3600;
  const double wait = std::clamp(facts.wait_s.value_or(0), 0.0, kMaxWaitSeconds);
  return facts.transition_frames.back() - static_cast<int>(std::lround(wait * rate_hz));
}

bool CanBeShown(const RecordedTransition& recorded) {
  return recorded.row->result.status == Status::kOk && !recorded.facts.transition_frames.empty();
}

std::vector<const RecordedTransition*> ShownOf(const RecordedRequest& world, const std::vector<std::string>& methods) {
  std::vector<const RecordedTransition*> shown;
  for (const std::string& method : methods) {
    const auto found = std::ranges::find_if(
        world.transitions, [&](const RecordedTransition& s) { return s.row->method == method && CanBeShown(s); });
    if (found != world.transitions.end() && shown.size() < kMaxTransitionPaths) shown.push_back(&*found);
  }
  return shown;
}

constexpr int kBefore = kFilmRate, kAfter = 3 * kFilmRate / 2;
// The film lasts until kAfter frames after the last transition, but transitions later than kLatest frames after the
// request do not count: if a method makes its transition much later, the film ends while the method still waits.
constexpr int kLatest = 4 * kFilmRate;
// The numbers of frames before and after a transition point that are repeated in slow motion.
constexpr int kSlowBefore = kFilmRate / 3, kSlowAfter = 2 * kFilmRate / 3;
constexpr int kMaxSlowFrames = 5 * kFilmRate / 2;

}  // namespace

int TransitionPath::FrameAt(int time) const {
  return std::clamp(request + time, 0, static_cast<int>(motion.poses.size()) - 1);
}

bool TransitionPath::IsRecordedAt(int time) const { return request + time >= 0; }

std::size_t TransitionPath::PointsBefore(int time) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(facts.transition_frames, [&](int point) { return TimeOf(point) < time; }));
}

TransitionRace RaceIn(const RecordedRequest& world, const ScenarioSummary& scenario,
                      const std::vector<std::string>& methods) {
  TransitionRace race{.world = world.Name(), .request = world.Request(), .choice = {}, .paths = {}};
  for (const RecordedTransition* recorded : ShownOf(world, methods)) {
    const BodyMotion& motion = *FindTrack(*recorded->recording, "coach");
    const std::string& method = recorded->row->method;
    race.paths.push_back({.method = method,
                          .method_index = IndexOf(scenario, method),
                          .facts = recorded->facts,
                          .motion = motion,
                          .jumps_cm = SecondDifferencesCm(motion),
                          .request = RequestOf(recorded->facts, motion.rate_hz)});
  }
  return race;
}

Result<TransitionRace> FindTransitionRace(const RunData& run, const ScenarioSummary& scenario) {
  // Find the world with recordings of the most methods.
  const std::vector<RecordedRequest> worlds = RecordedRequestsOf(run, scenario);
  const RecordedRequest* best = nullptr;
  std::size_t shown = 0;
  for (const RecordedRequest& world : worlds) {
    const std::size_t candidates = ShownOf(world, scenario.methods).size();
    if (candidates <= shown) continue;
    best = &world;
    shown = candidates;
  }
  if (worlds.empty()) {
    return Fail({},
                "this run kept no recordings of this scenario's transitions (the scenario key 'video' selects cells to "
                "record)");
  }
  if (shown == 0) return Fail({}, "no recording has both the change of clips and its 'transition_frame'");
  TransitionRace race = RaceIn(*best, scenario, scenario.methods);
  race.choice = fmt::format("the first of the worlds with transitions by the largest number of methods, among {}",
                            Plural(static_cast<long long>(worlds.size()), "recorded world"));
  return race;
}

TransitionClock::TransitionClock(const TransitionRace& race) {
  int earliest = kLatest, latest = 0;
  for (const TransitionPath& path : race.paths) {
    earliest = std::min(earliest, path.FirstPoint());
    if (path.LastPoint() <= kLatest) latest = std::max(latest, path.LastPoint());
  }
  first_ = -kBefore;
  last_ = std::clamp(latest + kAfter, kBefore, kLatest + kAfter);
  slow_first_ = std::clamp(earliest - kSlowBefore, first_, last_);
  slow_last_ = std::clamp(std::min(latest + kSlowAfter, slow_first_ + kMaxSlowFrames), slow_first_, last_);
}

int TransitionClock::TimeAt(int frame) const {
  if (!IsSlow(frame)) return std::min(first_ + frame, last_);
  return std::min(slow_first_ + (frame - Run() - kRest) / kSlowness, slow_last_);
}

int TransitionClock::FrameOf(int time) const { return std::clamp(time, first_, last_) - first_; }

}  // namespace etude
