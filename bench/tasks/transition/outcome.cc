#include "bench/tasks/transition/outcome.h"

#include <algorithm>

namespace etude {

FrameWindow AroundPoints(const Splice& splice, double seconds) {
  const int reach = static_cast<int>(seconds * splice.motion.rate_hz);
  return {std::max(splice.points.front().frame - reach, 0),
          std::min(splice.points.back().frame + reach, static_cast<int>(splice.motion.poses.size()) - 1)};
}

const FuzzyDistance& WorstDistance(const TransitionRecord& record) {
  return *std::max_element(record.distances.begin(), record.distances.end(),
                           [](const FuzzyDistance& a, const FuzzyDistance& b) { return a.value < b.value; });
}

}  // namespace etude
