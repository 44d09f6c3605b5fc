#include "reports/films/transition_clock.h"

#include <algorithm>

namespace etude {
namespace {

constexpr int kBefore = kFilmRate, kAfter = 3 * kFilmRate / 2;
// The film ends by then: a method that waits longer is seen still waiting.
constexpr int kLatest = 4 * kFilmRate;
// Long enough to see what leads to a transition and what follows it; the same stretch is shown in slow motion.
constexpr int kSlowBefore = kFilmRate / 3, kSlowAfter = 2 * kFilmRate / 3;
constexpr int kLongestSlow = 5 * kFilmRate / 2;

}  // namespace

TransitionClock::TransitionClock(const TransitionRace& race) {
  int earliest = kLatest, latest = 0;
  for (const TransitionPath& path : race.paths) {
    earliest = std::min(earliest, path.FirstPoint());
    if (path.LastPoint() <= kLatest) latest = std::max(latest, path.LastPoint());
  }
  first_ = -kBefore;
  last_ = std::clamp(latest + kAfter, kBefore, kLatest + kAfter);
  slow_first_ = std::clamp(earliest - kSlowBefore, first_, last_);
  slow_last_ = std::clamp(std::min(latest + kSlowAfter, slow_first_ + kLongestSlow), slow_first_, last_);
}

int TransitionClock::TimeAt(int frame) const {
  if (!IsSlow(frame)) return std::min(first_ + frame, last_);
  return std::min(slow_first_ + (frame - Run() - kRest) / kSlowness, slow_last_);
}

int TransitionClock::FrameOf(int time) const { return std::clamp(time, first_, last_) - first_; }

}  // namespace etude
