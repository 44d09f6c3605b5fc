#include "sim/music/music_clock.h"

#include <cmath>

namespace etude {

MusicClock::MusicClock(const MusicClockOptions& options, const WorldKey& world)
    : options_(options), stutters_(world, "music-stutters") {}

void MusicClock::PlayFrom(double music_s) {
  now_s_ = music_s;
  playing_ = true;
}

void MusicClock::Pause() { playing_ = false; }

void MusicClock::Tick() {
  const bool stutters = stutters_.Chance(options_.stutters_per_min / 60 / kJudgedRateHz);
  if (standing_ > 0) {
    --standing_;
  } else if (stutters) {
    standing_ = static_cast<int>(std::lround(options_.stutter_s * kJudgedRateHz));
  }
  if (playing_ && standing_ == 0) now_s_ += (1 + options_.drift) / kJudgedRateHz;
}

}  // namespace etude
