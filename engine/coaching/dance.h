#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"

namespace etude {

/// A frame that belongs to a moment of the music (paper A, 3.4: the next move is slowed or sped up by it).
struct MusicTag {
  std::size_t frame = 0;
  double music_s = 0;
};

/// A move of the dance, as the coach knows it.
struct DanceMove {
  std::string name;   ///< as the recogniser was taught it
  std::string hint;   ///< the key pose in words: "both arms up"
  BodyPose key_pose;  ///< its picture
  BodyMotion slow;    ///< the slow demonstration, 30 Hz; two frames at least
};

/// One performance that the player is to join in: the frames [first, end) of the dance.
struct Repetition {
  int move = 0;  ///< of Dance::moves
  std::size_t first = 0;
  std::size_t end = 0;
};

/// A clip that the coach plays beside the dance.
struct CoachAct {
  std::string name;
  BodyMotion motion;  ///< 30 Hz, two frames at least
  bool loops = false;
};

/// A dance to a song as data: all that a coach shows. Everything is danced by one body, which faces +Z.
struct Dance {
  std::string title;
  double tempo_bpm = 120;
  BodyMotion motion = {};                    ///< 30 Hz, the whole song
  std::vector<DanceMove> moves = {};         ///< names all different
  std::vector<Repetition> repetitions = {};  ///< in order, none overlaps the next
  std::vector<MusicTag> tags = {};           ///< frames and moments ascend strictly; at most one per frame
  std::vector<CoachAct> acts = {};           ///< those of RequiredActs() at least
  std::vector<double> beats_s = {};  ///< of the music: when each beat sounds, ascending (click tracks, beat errors)

  const CoachAct* FindAct(std::string_view name) const;
};

/// Lists "standby", "attract", "doze", "wake", "head_shake", "wave", "puzzled", "praise".
std::vector<std::string> RequiredActs();

/// Refuses a dance that breaks what its fields promise, and says why.
Result<void> CheckDance(const Dance& dance);

/// The moment of the music that belongs to a frame of the dance, seconds: straight between two tags, and at 30 Hz
/// before the first and after the last.
double MusicAt(const Dance& dance, double frame);

/// The first tag of the dance at `frame` or after it.
int NextTag(const Dance& dance, double frame);

/// Paper A's music-time tags (3.4): how many frames of the dance to show per frame, from `frame` on, where `music_s` is
/// heard, so that tag `next` (beyond the last one: the dance's end) is reached when its moment is. Below 1 the move is
/// slowed, above it is hurried; within [slowest, fastest].
double RateToTag(const Dance& dance, int next, double frame, double music_s, double slowest, double fastest);

}  // namespace etude
