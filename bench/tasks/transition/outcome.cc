#include "bench/tasks/transition/outcome.h"

#include <algorithm>

namespace etude {

FrameWindow AroundSeams(const Splice& splice, double seconds) {
  const int reach = static_cast<int>(seconds * splice.motion.rate_hz);
  return {std::max(splice.seams.front().frame - reach, 0),
          std::min(splice.seams.back().frame + reach, static_cast<int>(splice.motion.poses.size()) - 1)};
}

const FuzzyDistance& WorstMeeting(const SwitchRecord& record) {
  return *std::max_element(record.meetings.begin(), record.meetings.end(),
                           [](const FuzzyDistance& a, const FuzzyDistance& b) { return a.value < b.value; });
}

}  // namespace etude
