#include "engine/coaching/tempo.h"

#include <algorithm>

namespace etude {

double MusicAt(const Dance& dance, double frame) {
  const auto& tags = dance.tags;
  if (tags.empty()) return frame / kJudgedRateHz;
  const int next = NextTag(dance, frame);
  if (next == 0) return tags.front().music_s - (static_cast<double>(tags.front().frame) - frame) / kJudgedRateHz;
  const MusicTag& before = tags[next - 1];
  const double since = frame - static_cast<double>(before.frame);
  if (next == static_cast<int>(tags.size())) return before.music_s + since / kJudgedRateHz;
  const MusicTag& after = tags[next];
  return before.music_s + since * (after.music_s - before.music_s) / static_cast<double>(after.frame - before.frame);
}

int NextTag(const Dance& dance, double frame) {
  const auto next = std::ranges::lower_bound(dance.tags, frame, {},
                                             [](const MusicTag& tag) { return static_cast<double>(tag.frame); });
  return static_cast<int>(next - dance.tags.begin());
}

double RateToTag(const Dance& dance, int next, double frame, double music_s, double slowest, double fastest) {
  const double target = next < static_cast<int>(dance.tags.size()) ? static_cast<double>(dance.tags[next].frame)
                                                                   : static_cast<double>(dance.motion.poses.size() - 1);
  const double frames = target - frame, music_frames = (MusicAt(dance, target) - music_s) * kJudgedRateHz;
  // The music is there already: as fast as may be.
  if (music_frames <= 0) return fastest;
  return std::clamp(frames / music_frames, slowest, fastest);
}

}  // namespace etude
