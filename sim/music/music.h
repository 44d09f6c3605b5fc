#pragma once

#include <span>
#include <vector>

#include "engine/motion/body.h"
#include "sim/random/stream.h"

namespace etude {

/// The faults of a music player, compared with the dance's own clock.
struct MusicClockOptions {
  double drift = 0;             ///< it plays 1 + drift seconds of music in a second
  double stutters_per_min = 0;  ///< how often it stands still, on average
  double stutter_s = 0.2;       ///< for how long; it goes on where it stood
};

/// Simulated music, at 30 Hz: what is heard at every frame of a session. One throw of the dice per frame whatever it is
/// told, so that its stutters fall on the same frames of the session for every coach.
class MusicClock {
 public:
  MusicClock(const MusicClockOptions& options, const WorldKey& world);

  void PlayFrom(double music_s);
  void Pause();
  /// Moves the clock on by one frame.
  void Tick();
  /// Returns the position in the song, seconds.
  double Now() const { return now_s_; }
  bool IsPlaying() const { return playing_; }

 private:
  MusicClockOptions options_;
  RandomStream stutters_;
  double now_s_ = 0;
  bool playing_ = false;
  int standing_ = 0;  // frames that the stutter still lasts
};

/// Makes a click on every beat, the first of four higher: samples in [-1, 1] of one channel, `duration_s` long.
/// `beats_s` ascend; beats outside are silent.
std::vector<double> ClickTrack(std::span<const double> beats_s, double duration_s, int rate_hz = 44100);

}  // namespace etude
