#pragma once

#include <span>
#include <vector>

#include "engine/motion/body.h"
#include "sim/random/stream.h"

namespace etude {

/// The errors of a music player's clock, relative to the dance's own clock.
struct MusicClockOptions {
  double drift = 0;             ///< the music plays at 1 + drift times its correct speed
  double stutters_per_min = 0;  ///< mean number of interruptions per minute
  double stutter_s = 0.2;       ///< duration of an interruption; the music then continues where it stopped
};

/// A simulated music player at 30 Hz: it gives the position in the song at every frame of a session. The player draws
/// one random number per frame, also while it is paused. Therefore the stutters are on the same frames of the session
/// for every coach.
class MusicClock {
 public:
  MusicClock(const MusicClockOptions& options, const WorldKey& world);

  /// Jumps to a position in the song, seconds, and plays from there. The jump does not end a stutter that has begun.
  void PlayFrom(double music_s);
  /// Stops at the present position.
  void Pause();
  /// Advances the clock by one frame.
  void Tick();
  /// Returns the position in the song, seconds.
  double Now() const { return now_s_; }
  bool IsPlaying() const { return playing_; }

 private:
  MusicClockOptions options_;
  RandomStream stutters_;
  double now_s_ = 0;
  bool playing_ = false;
  int standing_ = 0;  // remaining frames of the current stutter
};

/// Makes a track with a click on every beat; the first click of every four is higher. Returns the samples of one
/// channel in [-1, 1]; the track is `duration_s` long. `beats_s` must ascend; beats outside the duration are left out.
std::vector<double> ClickTrack(std::span<const double> beats_s, double duration_s, int rate_hz = 44100);

}  // namespace etude
