#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/coaching/coach_output.h"
#include "engine/coaching/dance.h"
#include "engine/coaching/playback.h"
#include "engine/coaching/policy.h"
#include "engine/recognition/recogniser.h"
#include "engine/recognition/skeleton_stream.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// The state that SeeClap keeps between two frames.
struct ClapState {
  int since_apart = kLongAgo;  ///< number of frames since the hands were last apart
  int together = 0;            ///< number of consecutive frames in which the hands have been together
  static constexpr int kLongAgo = 1000;
};

/// Must be called once per frame, at 30 Hz. Returns true in the frame in which a clap is detected: both hands are
/// tracked and above the hips, and have come together within half a second of being apart.
bool SeeClap(const SensedFrame& frame, ClapState& state);

/// The state that SeeMotion keeps between two frames.
struct StillnessState {
  std::array<glm::dvec3, kRoleCount> rest{};  ///< recent position of each joint, low-pass filtered
  bool started = false;
  int seen = 0;    ///< number of frames since ResetCounts in which a body was seen
  int moving = 0;  ///< number of frames since ResetCounts in which the body moved
  int frames = 0;  ///< number of all frames since ResetCounts
};

/// Must be called once per frame, at 30 Hz. Returns true if the body is seen and moves.
bool SeeMotion(const SensedFrame& frame, StillnessState& state);
/// Restarts the counts but keeps the joints' rest positions.
void ResetCounts(StillnessState& state);

/// The settings of a coach. Times are in seconds; values are ours where paper A gives none.
struct CoachOptions {
  /// The evidence at which a performance counts as right, in (0, 1]. Recognisers need different values: to compare
  /// recognisers, choose values that give equal false-alarm rates.
  double right_from = 0.5;
  /// A window is the time in which a performance is judged. It opens and closes this time after the coach's repetition
  /// begins and ends, because learners follow with a lag.
  double reaction_s = 0.3;
  /// True if the player dances as in a mirror: the player's left side follows the coach's right side. The caller must
  /// then mirror the input. CoachSession reads this option and does so; Coach does not read it.
  bool player_mirrors = false;
  /// After this number of consecutive mistakes, the coach plays the act `puzzled` in place of head shake or wave.
  int puzzled_after = 3;
  /// The maximum number of corrections of one repetition; then the dance continues.
  int most_corrections = 3;
  /// The share of right performances, among the judged performances of a song, that earns praise at the end.
  double praise_share = 0.8;
  /// If the body moved in less than this share of a window's frames, the player stood still.
  double still_share = 0.1;
  /// After this time without motion, or without a player in sight, the coach leaves the dance or standby and plays the
  /// act `attract`, which invites players.
  double idle_s = 30;
  /// After this time in the act `attract`, the coach plays the act `doze`.
  double doze_s = 30;
  /// The limits of the tempo that music tags may set, in frames of the dance per shown frame.
  double slowest = 0.8, fastest = 1.25;
  bool follows_tags = true;  ///< false: the dance keeps its own tempo, regardless of the music
  /// The sensor's position in the world, and the limits of the player's distance from it on the floor, in metres.
  glm::dvec3 sensor{0, 1, 2.75};
  double nearest_m = 1.5, farthest_m = 3.6;
};

/// The input of one frame.
struct CoachInput {
  SeenFrame seen;  ///< the player; mirrored if players mirror the coach
  /// The evidence of the MoveFollower, which follows the move of the open window.
  Evidence evidence = {};
  std::optional<double> other_side = {};  ///< Evidence::asked of the mirror image; nullopt if it is not computed
  std::optional<double> music_s = {};     ///< position in the song that is heard now, in seconds; nullopt without music
  /// For policy `oracle`: true if the requested performance was right. It is read in the frame in which the window
  /// closes.
  std::optional<bool> told_right = {};
  bool moment = false;  ///< true: policy `yoked` corrects as soon as the dance can be interrupted
};

/// The whole state of a session, in plain values; it can be copied.
struct CoachState {
  std::int64_t frame = 0;
  CoachMode mode = CoachMode::kStandby;
  std::int64_t mode_since = 0;  ///< first frame of the current mode
  Playback playback;

  // State of the player, the person in front of the sensor.
  ClapState clap;
  bool clap_waits = false;  ///< true from the detection of a clap until the coach reacts to it
  StillnessState stillness;
  std::int64_t idle_since = 0;  ///< the last frame in which somebody took part
  PlayerHint stand = PlayerHint::kNone;
  int stand_frames = 0;  ///< number of consecutive frames in which the position calls for another hint than `stand`

  // State of the dance and the music.
  bool music_plays = false;
  double rate = 1;  ///< frames of the dance per shown frame
  int next_tag = 0;
  int next_window = 0;  ///< the repetition whose window opens next
  std::optional<OpenWindow> open;
  bool decided = false;       ///< true if the open window was judged before its end
  int correcting = -1;        ///< the repetition that was corrected last
  int corrections_here = 0;   ///< number of consecutive corrections of the repetition `correcting`
  bool moment_waits = false;  ///< CoachInput::moment was set while the dance could not be interrupted
  std::string_view say;
  std::int64_t say_until = 0;  ///< frame at which `say` ends

  // Memory of the performances in this song.
  std::vector<MoveMemory> moves;  ///< memory of each move of the dance
  MoveMemory song;                ///< sums over all moves
};

/// The next state and the output.
struct CoachStep {
  CoachState state;
  CoachOutput output;
};

/// Paper A's coach as a state machine. It is immutable, and any number of sessions can share it. It gets the
/// recogniser's evidence, but not the truth about what was danced.
///
///     Coach coach(transitions, {}, {FindPolicy("at-first-mistake"), {}});
///     CoachState state = coach.Begin();
///     for (each frame) std::tie(state, output) = coach.Step(std::move(state), {.seen = …, .evidence = …});
class Coach {
 public:
  struct PolicyChoice {
    const Policy* policy = nullptr;
    std::vector<double> settings;  ///< one value per setting of the policy; if empty, the defaults apply
  };

  /// Makes a coach. `transitions` must outlive the coach.
  Coach(const DanceTransitions& transitions, const CoachOptions& options, PolicyChoice policy);

  const Dance& dance() const { return transitions_.dance(); }
  const CoachOptions& options() const { return options_; }

  /// Returns the state of a coach in standby. Standby lasts until somebody claps.
  CoachState Begin() const;
  /// Returns the state of a coach at the dance's first frame, as after a clap.
  CoachState BeginDancing() const;

  /// Plans the most likely transitions in advance, so that no frame of a live session waits for a plan: from every
  /// window's end into every corrective act, from the acts into the demonstrations, and back into the dance. This does
  /// not change any result.
  void PlanAhead() const;

  /// Processes one frame. This is a pure function: the same inputs give the same outputs.
  CoachStep Step(CoachState state, const CoachInput& input) const;

 private:
  const DanceTransitions& transitions_;
  CoachOptions options_;
  PolicyChoice policy_;
};

}  // namespace etude
