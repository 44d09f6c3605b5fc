#include "reports/films/race_clock.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

constexpr double kSecondsPerDoubling = 0.7;
constexpr double kShortestRace = 4, kLongest = 8;  // seconds

}  // namespace

RaceClock::RaceClock(int last_iteration) : last_(last_iteration) {
  const double seconds = std::clamp(kSecondsPerDoubling * std::log2(1.0 + last_), kShortestRace, kLongest);
  run_ = static_cast<int>(std::lround(seconds * kFilmRate));
}

double RaceClock::IterationAt(int frame) const {
  if (frame >= kOpening + run_) return last_;
  const double share = std::max(frame - kOpening, 0) / static_cast<double>(run_);
  return std::min(std::expm1(share * std::log1p(last_)), static_cast<double>(last_));
}

double RaceClock::ShareOf(double iteration) const {
  return last_ == 0 ? 0 : std::clamp(std::log1p(iteration) / std::log1p(last_), 0.0, 1.0);
}

}  // namespace etude
