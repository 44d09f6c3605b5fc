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

/// What the coach knows of a move of its dance.
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

/// Something the coach does beside dancing.
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

/// "standby", "attract", "doze", "wake", "head_shake", "wave", "puzzled", "praise".
std::vector<std::string> RequiredActs();

/// What is wrong with a dance, if anything.
Result<void> CheckDance(const Dance& dance);

}  // namespace etude
