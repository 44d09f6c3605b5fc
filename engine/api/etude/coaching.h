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
  std::string name;  ///< unique in a dance
  std::string hint;  ///< the key pose in words, for the player
  Pose key_pose;
  Motion slow;  ///< the slow demonstration
};

/// One performance in which the player should join: the frames [first, end) of the dance.
struct Repetition {
  int move = 0;  ///< index in Dance::moves
  std::size_t first = 0, end = 0;
};

/// A frame of the dance and the moment of the music to which it belongs.
struct MusicTag {
  std::size_t frame = 0;
  double music_s = 0;
};

/// A clip that the coach plays besides the dance.
struct CoachAct {
  std::string name;
  Motion motion;
  bool loops = false;
};

/// All that a coach shows, danced by one body that faces +Z. Motions have 30 Hz and at least two frames.
struct Dance {
  std::string title;
  Motion motion = {};  ///< the whole song
  std::vector<DanceMove> moves = {};
  std::vector<Repetition> repetitions = {};  ///< in order, without overlap, each of at least two frames
  std::vector<MusicTag> tags = {};           ///< frames and moments ascend
  std::vector<CoachAct> acts = {};           ///< at least those of RequiredActs()
};

/// The acts that every dance has: "standby", "attract", "doze", "wake", "head_shake", "wave", "puzzled", "praise".
ETUDE_API std::vector<std::string> RequiredActs();
/// The rules that decide when a coach interrupts: "at-first-mistake" (paper A's), "never", …
ETUDE_API std::vector<std::string> CoachPolicies();

struct CoachOptions {
  std::string policy = "at-first-mistake";  ///< one of CoachPolicies()
  std::string choice = "played";            ///< as TransitionOptions::choice, for transitions between clips
  std::string join = "planted-feet";        ///< as TransitionOptions::join
  std::string recogniser = "whole-body";    ///< or "dtw", "nearest"
  bool smooths = false;                     ///< the stream goes through Kinect's own filter first
  bool mirrors = false;                     ///< players dance as in a mirror: the coach's left side is their right side
  bool dances_at_once = false;              ///< begins without a clap
  /// The evidence at or above which a performance is right, in (0, 1]; nullopt: the recogniser's own.
  std::optional<double> right_from = {};
  /// The place of the sensor, metres; players are asked to stand 1.5 to 3.6 m from it.
  glm::dvec3 sensor_m{0, 1, 2.75};
};

/// A decision of the coach, explained.
struct CoachDecision {
  std::string event;        ///< "woken", "song begins", "right", "wrong", "corrects", "shows", "transition", …
  std::int64_t frame = 0;   ///< since the session began
  std::optional<int> move;  ///< index of the move in the dance, if the decision is about one
  std::string mistake;      ///< "" if the decision is about no mistake
  double evidence = 0;      ///< for "right" and "wrong"
  std::string why;          ///< one sentence with numbers
};

/// The output of the coach for one frame.
struct CoachFrame {
  std::string mode;  ///< "standby", "attract", "doze", "wake", "dance", "correct", "demonstrate", "praise"
  Pose body;
  std::string clip;       ///< "dance", an act's name, or "slow_" and a move's name; in a transition the next clip
  double clip_frame = 0;  ///< of that clip
  bool in_transition = false;
  std::optional<int> asked;           ///< the move that the player is asked for from the next frame on
  std::string say, hint;              ///< a line for the player, the key pose in words; "" = none
  std::string stand;                  ///< "come into view", "come nearer", "step back" or ""
  std::optional<double> play_from_s;  ///< the position in the song if music begins in this frame
  bool pause_music = false;
  std::vector<CoachDecision> decisions;
};

/// Paper A's coach with a sensor: watches a player, shows a dance, corrects, and says why. Frame by frame, at 30 Hz.
class ETUDE_API Coach {
 public:
  /// @param moves right performances of the moves of the dance, in its order. Throws BadInput for a dance that breaks
  /// the rules of its fields, for moves that are not in the dance, and for unknown names.
  Coach(const Dance& dance, std::span<const TaughtMove> moves, const CoachOptions& options = {});
  Coach(Coach&&) noexcept;
  Coach& operator=(Coach&&) noexcept;
  ~Coach();

  /// Takes the sensor's next frame and returns the coach's next frame. `music_s` is the position of the heard music,
  /// seconds into the song; nullopt: no music. Throws BadInput for positions that are not finite, and for a `music_s`
  /// outside 0 to 10⁶.
  CoachFrame Step(const SensedPose& frame, std::optional<double> music_s = {});

 private:
  struct Session;
  std::unique_ptr<Session> session_;
};

}  // namespace etude::engine
