#pragma once

#include <etude/motion.h>
#include <etude/recognition.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace etude::engine {

/// A move of a dance, as the coach shows it.
struct DanceMove {
  std::string name;  ///< all of a dance's differ
  std::string hint;  ///< the key pose in words, for the player
  Pose key_pose;
  Motion slow;  ///< the slow demonstration
};

/// One performance that the player is to join in: the frames [first, end) of the dance.
struct Repetition {
  int move = 0;  ///< of Dance::moves
  std::size_t first = 0, end = 0;
};

/// A frame of the dance that belongs to a moment of the music.
struct MusicTag {
  std::size_t frame = 0;
  double music_s = 0;
};

/// A clip that the coach plays beside the dance.
struct CoachAct {
  std::string name;
  Motion motion;
  bool loops = false;
};

/// All that a coach shows, danced by one body that faces +Z; motions run at 30 Hz and have two frames at least.
struct Dance {
  std::string title;
  Motion motion = {};  ///< the whole song
  std::vector<DanceMove> moves = {};
  std::vector<Repetition> repetitions = {};  ///< in order, none overlaps the next, two frames each at least
  std::vector<MusicTag> tags = {};           ///< frames and moments ascend
  std::vector<CoachAct> acts = {};           ///< those of RequiredActs() at least
};

/// The acts that every dance has: "standby", "attract", "doze", "wake", "head_shake", "wave", "puzzled", "praise".
ETUDE_API std::vector<std::string> RequiredActs();
/// The rules for when a coach interrupts: "at-first-mistake" (paper A's), "never", …
ETUDE_API std::vector<std::string> CoachPolicies();

struct CoachOptions {
  std::string policy = "at-first-mistake";  ///< one of CoachPolicies()
  std::string choice = "played";            ///< as TransitionOptions::choice, of ways from clip to clip
  std::string join = "planted-feet";        ///< as TransitionOptions::join
  std::string recogniser = "whole-body";    ///< or "dtw", "nearest"
  bool smooths = false;                     ///< the stream goes through Kinect's own filter first
  bool mirrors = false;                     ///< players dance as in a mirror: the coach's left is their right
  bool dances_at_once = false;              ///< begins without a clap
  /// A performance is right from this evidence on, in (0, 1]; nothing: the recogniser's own.
  std::optional<double> right_from = {};
  /// The place of the sensor, metres; players are asked to stand 1.5 to 3.6 m from it.
  glm::dvec3 sensor_m{0, 1, 2.75};
};

/// A decision of the coach, explained.
struct CoachDecision {
  std::string event;        ///< "woken", "song begins", "right", "wrong", "corrects", "shows", "transition", …
  std::int64_t frame = 0;   ///< since the session began
  std::optional<int> move;  ///< of the dance, where it speaks of one
  std::string mistake;      ///< "" where none is spoken of
  double evidence = 0;      ///< of "right", "wrong"
  std::string why;          ///< one sentence with numbers
};

/// The coach as one frame shows it.
struct CoachFrame {
  std::string mode;  ///< "standby", "attract", "doze", "wake", "dance", "correct", "demonstrate", "praise"
  Pose body;
  std::string clip;       ///< "dance", an act's name, "slow_" and a move's; in a transition the next
  double clip_frame = 0;  ///< of that clip
  bool in_transition = false;
  std::optional<int> asked;           ///< the move that the player is asked for from the next frame on
  std::string say, hint;              ///< a line for the player, the key pose in words; "" = none
  std::string stand;                  ///< "come into view", "come nearer", "step back" or ""
  std::optional<double> play_from_s;  ///< music that begins in this frame: from where in the song
  bool pause_music = false;
  std::vector<CoachDecision> decisions;
};

/// Paper A's coach with a sensor: watches a player, shows a dance, corrects, and says why. Frame by frame, at 30 Hz.
class ETUDE_API Coach {
 public:
  /// @param moves the moves of the dance, in their order, as they look when they are right
  /// Throws BadInput for a dance that breaks what its fields promise, moves that are not its, and names that there are
  /// not.
  Coach(const Dance& dance, std::span<const TaughtMove> moves, const CoachOptions& options = {});
  Coach(Coach&&) noexcept;
  Coach& operator=(Coach&&) noexcept;
  ~Coach();

  /// Takes the sensor's next frame and shows the next. `music_s`: what is heard now, seconds into the song; nothing: no
  /// music. Throws BadInput for places that are not finite, and for music that is neither nor from 0 to 10⁶.
  CoachFrame Step(const SensedPose& frame, std::optional<double> music_s = {});

 private:
  struct Session;
  std::unique_ptr<Session> session_;
};

}  // namespace etude::engine
