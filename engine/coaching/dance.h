#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"

namespace [[gnu::visibility("default")]] etude {

/// A frame of the dance, and the music time at which this frame should be shown (paper A, 3.4: the next move is slowed
/// down or sped up).
struct MusicTag {
  std::size_t frame = 0;
  double music_s = 0;
};

struct DanceMove {
  std::string name;   ///< the name of this move in the recogniser
  std::string hint;   ///< the key pose in words, for example "both arms up"
  BodyPose key_pose;  ///< the pose that `hint` describes
  BodyMotion slow;    ///< slow demonstration at 30 Hz, at least two frames
};

/// One performance in which the player should join, as the frames [first, end) of the dance.
struct Repetition {
  int move = 0;  ///< index in Dance::moves
  std::size_t first = 0;
  std::size_t end = 0;
};

/// A clip that the coach plays outside the dance.
struct CoachAct {
  std::string name;
  BodyMotion motion;  ///< motion at 30 Hz, at least two frames
  bool loops = false;
};

/// A dance to one song: all the data that a coach shows. One body performs everything and faces +Z.
struct Dance {
  std::string title;
  double tempo_bpm = 120;
  BodyMotion motion = {};                    ///< the whole song at 30 Hz
  std::vector<DanceMove> moves = {};         ///< the moves, with unique names
  std::vector<Repetition> repetitions = {};  ///< the repetitions, in order and without overlap
  std::vector<MusicTag> tags = {};           ///< the tags; their frames and times ascend strictly
  std::vector<CoachAct> acts = {};           ///< the acts; at least those of RequiredActs()
  std::vector<double> beats_s = {};  ///< times of the music's beats, ascending (for click tracks and beat errors)

  const CoachAct* FindAct(std::string_view name) const;
};

/// Returns "standby", "attract", "doze", "wake", "head_shake", "wave", "puzzled", "praise".
std::vector<std::string> RequiredActs();

/// Returns the music time of a frame of the dance, in seconds: interpolated linearly between two tags, and at 30 Hz
/// before the first and after the last tag.
double MusicAt(const Dance& dance, double frame);

/// Returns the index of the dance's first tag at `frame` or later.
int NextTag(const Dance& dance, double frame);

/// Returns the number of dance frames per shown frame with which the dance reaches the music-time tag `next` at its
/// time (paper A, 3.4), if the dance is at `frame` and the music at `music_s`. After the last tag, the end of the
/// dance takes the place of the tag. Below 1 the dance is slowed down, above 1 sped up; the result is clamped to
/// [slowest, fastest].
double RateToTag(const Dance& dance, int next, double frame, double music_s, double slowest, double fastest);

}  // namespace etude
