#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "engine/transitions/base/transition_record.h"

namespace etude {

/// What a coach decided.
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
/// "woken", "song begins", "right", …
std::string_view EventName(CoachEvent event);

/// Why a performance counts as a mistake.
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

}  // namespace etude
