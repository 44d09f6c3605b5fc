#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/coaching/dance.h"
#include "engine/coaching/playback.h"
#include "engine/coaching/policy.h"
#include "engine/recognition/recogniser.h"
#include "engine/recognition/skeleton_stream.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// The memory of SeeClap between two frames.
struct ClapState {
  int since_apart = kLongAgo;  ///< frames since the hands were last apart
  int together = 0;            ///< frames in a row for which they have been together
  static constexpr int kLongAgo = 1000;
};

/// Takes one frame, and returns true in the one in which a clap is seen: both hands, in sight and above the hips, have
/// met within half a second of being apart. At 30 Hz.
bool SeeClap(const SensedFrame& frame, ClapState& state);

/// The memory of SeeMotion between two frames.
struct StillnessState {
  std::array<glm::dvec3, kRoleCount> rest{};  ///< where each joint has been of late
  bool started = false;
  int seen = 0;    ///< frames with a body since the count began
  int moving = 0;  ///< of them in motion
  int frames = 0;  ///< all
};

/// Takes one frame of 30 Hz, and returns true when the body is seen and moves.
bool SeeMotion(const SensedFrame& frame, StillnessState& state);
/// Restarts the counts and keeps where the joints rest.
void ResetCounts(StillnessState& state);

/// The settings of a coach. Times are in seconds, and ours where paper A gives none.
struct CoachOptions {
  /// A performance counts as right from this evidence on, in (0, 1]. It depends on the recogniser: tune it where false
  /// alarms are to be equal.
  double right_from = 0.5;
  /// Windows open and close so much after the repetition that the coach dances: a learner follows with a lag.
  double reaction_s = 0.3;
  /// The player's left is the coach's right, as in a mirror: what is seen is mirrored before it is judged. Whoever
  /// feeds the coach does that (CoachSession); here it decides words only.
  bool player_mirrors = false;
  /// After this many mistakes in a row the coach is puzzled instead of shaking its head.
  int puzzled_after = 3;
  /// A repetition is corrected at most this often before the dance goes on.
  int most_corrections = 3;
  /// The share of a song's judged performances that must be right for praise at its end.
  double praise_share = 0.8;
  /// A window in which the body moved less than this share of the time is stood through.
  double still_share = 0.1;
  /// After so long without anybody moving or in sight, the coach leaves the dance or standby for the attract act.
  double idle_s = 30;
  /// After so much attracting the coach dozes off.
  double doze_s = 30;
  /// The limits within which tags may slow and hurry a move: frames of the dance per frame.
  double slowest = 0.8, fastest = 1.25;
  bool follows_tags = true;  ///< false: the dance keeps its own tempo, whatever the music does
  /// The sensor in the world, and how far from it on the floor the player should be, metres.
  glm::dvec3 sensor{0, 1, 2.75};
  double nearest_m = 1.5, farthest_m = 3.6;
};

/// A decision of the coach.
enum class CoachEvent {
  kWoken,       ///< a clap
  kSongBegins,  ///< the dance begins
  kRight,       ///< a window closed: right
  kWrong,       ///< a window closed: a mistake
  kUnjudged,    ///< a window closed and nothing could be said, or it was cut off
  kCorrects,    ///< leaves the dance for a corrective act
  kShows,       ///< begins a slow demonstration
  kReturns,     ///< back to the dance, at the repetition
  kGoesOn,      ///< leaves it at that after too many corrections of one repetition
  kPraises,     ///< a word after a mistake that was put right, or the act at the song's end
  kTag,         ///< a music-time tag was reached
  kTransition,  ///< how it gets from clip to clip
  kSongEnds,
  kAttracts,  ///< nobody takes part: come and dance!
  kDozes,
};
/// Returns "woken", "song begins", "right", ….
std::string_view EventName(CoachEvent event);

/// The reason why a performance counts as a mistake.
enum class Mistake {
  kNone,
  kNotReached,  ///< the move was not recognised
  kStoodStill,  ///< paper A, 3.1: not following is a mistake
  kWrongSide,   ///< its mirror image was recognised
};
std::string_view MistakeName(Mistake mistake);

/// A decision, explained.
struct CoachRecord {
  CoachEvent event = CoachEvent::kWoken;
  std::int64_t frame = 0;  ///< since the session began
  int repetition = -1;     ///< of the dance, where it speaks of one
  int move = -1;           ///< likewise
  int tag = -1;            ///< of the dance, of kTag
  Mistake mistake = Mistake::kNone;
  double evidence = 0;      ///< of kRight, kWrong, kUnjudged
  double beat_error_s = 0;  ///< of kTag: how much later the dance is there than the music; negative: earlier
  double rate = 1;          ///< of kTag: frames of the dance shown per frame from here on
  std::shared_ptr<const TransitionRecord> transition;  ///< of kTransition
  std::string why;                                     ///< one sentence with numbers
};

/// The states of the coach; README.md draws the arrows between them.
enum class CoachMode {
  kStandby,
  kAttract,
  kDoze,
  kWake,
  kDance,
  kCorrect,      ///< head shake, wave or puzzled
  kDemonstrate,  ///< the move, slowly: the player only watches
  kPraise,
};
/// Returns "standby", "attract", ….
std::string_view ModeName(CoachMode mode);

/// One frame's news.
struct CoachInput {
  SeenFrame seen;                         ///< the player; mirrored where players mirror the coach
  Evidence evidence = {};                 ///< of a follower that was asked what the step before asks
  std::optional<double> other_side = {};  ///< Evidence::asked of the mirror image, where somebody looks at it
  std::optional<double> music_s = {};     ///< what is heard now, seconds into the song; none: no music
  std::optional<bool> told_right = {};    ///< for `oracle`: was the performance asked for right? In its last frame
  bool moment = false;                    ///< for `yoked`: correct now, or as soon as there is a dance to interrupt
};

/// A request to the player to stand elsewhere.
enum class PlayerHint { kNone, kComeIntoView, kComeNearer, kStepBack };
/// Returns "", "come into view", "come nearer" or "step back".
std::string_view HintText(PlayerHint hint);

/// A command to whoever plays the music.
struct MusicCommand {
  enum class Kind { kNone, kPlayFrom, kPause };
  Kind kind = Kind::kNone;
  double music_s = 0;  ///< of kPlayFrom: what should be heard in this frame; on from there
};

/// The performance that the player is asked for: its window is open.
struct OpenWindow {
  int repetition = 0;  ///< of the dance
  int move = 0;
  friend bool operator==(const OpenWindow&, const OpenWindow&) = default;
};

/// The output of one frame: what is to be shown, and why.
struct CoachOutput {
  CoachMode mode = CoachMode::kStandby;
  BodyPose body;          ///< of the coach, now
  std::string_view clip;  ///< what it plays: "dance", an act's name, "slow_" and a move's; in a transition the next
  double clip_frame = 0;  ///< of that clip
  bool in_transition = false;         ///< between two clips, until the wanted one is entered
  int repetition = -1;                ///< that the coach dances; -1: none
  std::optional<OpenWindow> open;     ///< what the player is asked for from the next frame on
  bool asks = false;                  ///< `open` is news: MoveFollower::Ask before the next frame
  std::string_view say;               ///< a line for the player; "" = nothing
  std::string_view hint;              ///< the key pose asked for or shown, in words; lives as long as the dance
  const BodyPose* picture = nullptr;  ///< the same as a picture, likewise
  PlayerHint stand = PlayerHint::kNone;
  MusicCommand music;
  /// The lag of the dance behind the music while it dances to music, seconds; negative when it is early.
  std::optional<double> beat_error_s;
  std::vector<CoachRecord> records;  ///< what was decided in this frame, in order
};

/// The whole state of a session: plain values, to be copied at will.
struct CoachState {
  std::int64_t frame = 0;
  CoachMode mode = CoachMode::kStandby;
  std::int64_t mode_since = 0;  ///< frame
  Playback playback;

  // The player.
  ClapState clap;
  bool clap_waits = false;  ///< one was seen that nothing has come of yet
  StillnessState stillness;
  std::int64_t idle_since = 0;  ///< the last frame in which somebody took part
  PlayerHint stand = PlayerHint::kNone;
  int stand_frames = 0;  ///< for how long another hint would have been given

  // The dance.
  bool music_plays = false;
  double rate = 1;  ///< frames of the dance per frame
  int next_tag = 0;
  int next_window = 0;  ///< the repetition whose window opens next
  std::optional<OpenWindow> open;
  bool decided = false;       ///< the open window has come to right before its end
  int correcting = -1;        ///< the repetition that was corrected last
  int corrections_here = 0;   ///< how often, in a row
  bool moment_waits = false;  ///< one came while there was nothing to interrupt
  std::string_view say;
  std::int64_t say_until = 0;  ///< frame

  // What is remembered of this song.
  std::vector<MoveMemory> moves;  ///< of the dance
  MoveMemory song;                ///< all of them together
};

/// The next state, and what to show.
struct CoachStep {
  CoachState state;
  CoachOutput output;
};

/// Paper A's coach as a state machine (algorithms A8): constant, shared by any number of sessions. It knows what the
/// recogniser says and nothing of what was truly danced.
///
///     Coach coach(transitions, {}, {FindPolicy("at-first-mistake"), {}});
///     CoachState state = coach.Begin();
///     for (each frame) std::tie(state, output) = coach.Step(std::move(state), {.seen = …, .evidence = …});
class Coach {
 public:
  struct PolicyChoice {
    const Policy* policy = nullptr;
    std::vector<double> settings;  ///< one per setting; none: the defaults
  };

  /// Makes a coach; `transitions` must outlive it.
  Coach(const DanceTransitions& transitions, const CoachOptions& options, PolicyChoice policy);

  const Dance& dance() const { return transitions_.dance(); }
  const CoachOptions& options() const { return options_; }

  /// Begins in standby, which lasts until somebody claps.
  CoachState Begin() const;
  /// Begins in the dance's first frame, as if somebody had clapped.
  CoachState BeginDancing() const;

  /// Plans what a dance will most likely need, so that no frame of a live session has to wait for it: the ways out of
  /// every window into every corrective act, and on from there. Answers stay the same.
  void PlanAhead() const;

  /// Takes one frame. The function is pure: the same inputs give the same outputs.
  CoachStep Step(CoachState state, const CoachInput& input) const;

 private:
  const DanceTransitions& transitions_;
  CoachOptions options_;
  PolicyChoice policy_;
};

}  // namespace etude
