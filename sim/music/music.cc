#include "sim/music/music.h"

#include <cmath>
#include <cstddef>

#include "engine/base/angles.h"

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

std::vector<double> ClickTrack(std::span<const double> beats_s, double duration_s, int rate_hz) {
  constexpr double kClickSeconds = 0.03, kHighHz = 1760, kLowHz = 880, kLoudness = 0.8;
  constexpr std::size_t kBeatsPerBar = 4;
  std::vector<double> samples(static_cast<std::size_t>(std::ceil(duration_s * rate_hz)), 0.0);
  const auto length = static_cast<std::size_t>(kClickSeconds * rate_hz);
  for (std::size_t beat = 0; beat < beats_s.size(); ++beat) {
    if (beats_s[beat] < 0) continue;
    const auto first = static_cast<std::size_t>(std::llround(beats_s[beat] * rate_hz));
    const double pitch = beat % kBeatsPerBar == 0 ? kHighHz : kLowHz;
    for (std::size_t i = 0; i < length && first + i < samples.size(); ++i) {
      const double t = static_cast<double>(i) / rate_hz;
      // A cubic envelope lets the click decay to zero at its end.
      samples[first + i] = kLoudness * std::sin(2 * kPi * pitch * t) * std::pow(1 - t / kClickSeconds, 3);
    }
  }
  return samples;
}

}  // namespace etude
