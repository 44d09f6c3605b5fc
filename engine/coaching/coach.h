#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/coaching/clap.h"
#include "engine/coaching/coach_options.h"
#include "engine/coaching/coach_record.h"
#include "engine/coaching/dance.h"
#include "engine/coaching/playback.h"
#include "engine/coaching/policy.h"
#include "engine/coaching/stillness.h"
#include "engine/recognition/recogniser.h"

namespace etude {

/// What the coach does. Arrows: README.md.
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
/// "standby", "attract", …
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

/// Where the player should go.
enum class PlayerHint { kNone, kComeIntoView, kComeNearer, kStepBack };
/// "", "come into view", "come nearer", "step back".
std::string_view HintText(PlayerHint hint);

/// What the music is to do.
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

/// What to show, and why.
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
  /// While it dances to music: how much later the dance is than the music, seconds; negative: earlier.
  std::optional<double> beat_error_s;
  std::vector<CoachRecord> records;  ///< what was decided in this frame, in order
};

/// Everything that a session has come to: plain values, to be copied at will.
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

  /// `transitions` must outlive the coach.
  Coach(const DanceTransitions& transitions, const CoachOptions& options, PolicyChoice policy);

  const Dance& dance() const { return transitions_.dance(); }
  const CoachOptions& options() const { return options_; }

  /// Standing by, until somebody claps.
  CoachState Begin() const;
  /// In the dance's first frame, as if somebody had clapped.
  CoachState BeginDancing() const;

  /// Plans what a dance will most likely need, so that no frame of a live session has to wait for it: the ways out of
  /// every window into every corrective act, and on from there. Answers stay the same.
  void PlanAhead() const;

  /// The same inputs give the same outputs, and nothing else changes.
  CoachStep Step(CoachState state, const CoachInput& input) const;

 private:
  const DanceTransitions& transitions_;
  CoachOptions options_;
  PolicyChoice policy_;
};

}  // namespace etude
