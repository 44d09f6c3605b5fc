#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"

namespace [[gnu::visibility("default")]] etude {

struct TransitionRecord;

/// An event or decision of the coach. A window is the time in which the player's performance is judged.
enum class CoachEvent {
  kWoken,       ///< a clap was detected
  kSongBegins,  ///< the dance begins
  kRight,       ///< a window closed with a right performance
  kWrong,       ///< a window closed with a mistake
  kUnjudged,    ///< a window closed without a verdict, or was interrupted
  kCorrects,    ///< the coach leaves the dance for a corrective act
  kShows,       ///< a slow demonstration begins
  kReturns,     ///< the coach returns to the dance, at the repetition that was corrected
  kGoesOn,      ///< the dance continues after too many corrections of one repetition
  kPraises,     ///< praise: in words after a corrected mistake, or as an act at the song's end
  kTag,         ///< the dance reached a tag: a frame that is due at a set time of the music
  kTransition,  ///< a transition between clips begins
  kSongEnds,
  kAttracts,  ///< nobody takes part, so the coach invites people to dance
  kDozes,
};
/// Returns the event's name, for example "woken", "song begins" or "right".
std::string_view EventName(CoachEvent event);

/// The kind of mistake in a performance.
enum class Mistake {
  kNone,
  kNotReached,  ///< the move was not recognised
  kStoodStill,  ///< the player did not follow, which paper A (3.1) counts as a mistake
  kWrongSide,   ///< the mirror image of the move was recognised
};
std::string_view MistakeName(Mistake mistake);

/// A decision with its explanation.
struct CoachRecord {
  CoachEvent event = CoachEvent::kWoken;
  std::int64_t frame = 0;  ///< frame number, counted from the session's beginning
  int repetition = -1;     ///< index in Dance::repetitions; −1 if the record concerns no repetition
  int move = -1;           ///< index in Dance::moves; −1 if the record concerns no move
  int tag = -1;            ///< index in Dance::tags; set for the event kTag
  Mistake mistake = Mistake::kNone;
  double evidence = 0;      ///< evidence of the performance; set for the events kRight, kWrong and kUnjudged
  double beat_error_s = 0;  ///< set for kTag: the delay of the dance behind the music; negative if the dance is early
  double rate = 1;          ///< set for kTag: the new speed of the dance, in frames of the dance per shown frame
  std::shared_ptr<const TransitionRecord> transition;  ///< the planned transition; set for kTransition
  std::string why;                                     ///< reason for the event: one sentence with numbers
};

/// The states of the coach; README.md shows the transitions between them.
enum class CoachMode {
  kStandby,
  kAttract,
  kDoze,
  kWake,
  kDance,
  kCorrect,      ///< the act "head_shake", "wave" or "puzzled" is played
  kDemonstrate,  ///< a slow demonstration is shown; the player only watches
  kPraise,
};
/// Returns the mode's name, for example "standby" or "attract".
std::string_view ModeName(CoachMode mode);

/// A request that the player change position.
enum class PlayerHint { kNone, kComeIntoView, kComeNearer, kStepBack };
/// Returns "", "come into view", "come nearer" or "step back".
std::string_view HintText(PlayerHint hint);

/// A command to the music player.
struct MusicCommand {
  enum class Kind { kNone, kPlayFrom, kPause };
  Kind kind = Kind::kNone;
  double music_s = 0;  ///< for kPlayFrom: position in the song, in seconds, at which to start playing now
};

/// The performance that the player should give while its window is open.
struct OpenWindow {
  int repetition = 0;  ///< index in Dance::repetitions
  int move = 0;
  friend bool operator==(const OpenWindow&, const OpenWindow&) = default;
};

/// The output of one frame: what to show, and why.
struct CoachOutput {
  CoachMode mode = CoachMode::kStandby;
  BodyPose body;               ///< the coach's pose
  std::string_view clip;       ///< "dance", an act's name, or "slow_" and a move's name; in a transition, the next clip
  double clip_frame = 0;       ///< frame index in `clip`, may be fractional
  bool in_transition = false;  ///< true from leaving one clip until the next clip is entered
  int repetition = -1;  ///< the last repetition that has begun; −1 before the first and while no dance is shown
  std::optional<OpenWindow> open;     ///< the window that is open in the next frame
  bool asks = false;                  ///< true if `open` has changed: call MoveFollower::Ask before the next frame
  std::string_view say;               ///< a line of text for the player; "" if there is none
  std::string_view hint;              ///< key pose of the requested or shown move, in words; the Dance owns the text
  const BodyPose* picture = nullptr;  ///< the key pose of `hint` as a picture; the Dance owns it
  PlayerHint stand = PlayerHint::kNone;
  MusicCommand music;
  /// The delay of the dance behind the music, in seconds; negative if the dance is early, nullopt if it follows no
  /// music.
  std::optional<double> beat_error_s;
  std::vector<CoachRecord> records;  ///< the decisions of this frame, in order
};

}  // namespace etude
