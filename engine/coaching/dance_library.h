#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/coaching/dance.h"
#include "engine/transitions/library/library.h"

namespace etude {

/// Returns an error if the dance violates a rule that is stated at its fields.
Result<void> CheckDance(const Dance& dance);

/// A dance prepared for transitions, once for all sessions: a library of its acts, its slow demonstrations, and
/// excerpts around each repetition.
class DanceLibrary {
 public:
  /// Makes the library. Returns the errors of CheckDance.
  static Result<DanceLibrary> Make(Dance dance);

  const Dance& dance() const { return dance_; }
  const MotionLibrary& library() const { return library_; }

  // The following functions return clips of the library. A `repetition` of −1 stands for the song's beginning.
  // ClipOfAct returns the whole clip of an act, ClipOfSlow the whole clip of a slow demonstration; transitions leave
  // these clips.
  int ClipOfAct(std::string_view act) const;
  int ClipOfSlow(int move) const;
  /// Returns the excerpt of the dance from this repetition's beginning until some time into the next repetition; for
  /// the last repetition, to the song's end. Transitions leave the dance from this clip.
  int ClipLeaving(int repetition) const;
  /// Returns a clip that is only the beginning of clip `whole`, an act or slow demonstration. Transitions enter this
  /// clip, so that they cannot skip the main part.
  int ClipEntering(int whole) const;
  /// Returns the excerpt of the dance from some time before a repetition's beginning to some time after it. Transitions
  /// return to the dance through this clip.
  int ClipReturning(int repetition) const;

  /// Returns the clip that plays on after a transition has entered `clip`: if `clip` is only the beginning of an act or
  /// slow demonstration, the whole clip; else `clip` itself.
  int WholeOf(int clip) const;
  /// Returns the index of the last repetition that has begun when the dance is at `dance_frame`; −1 before the first.
  int RepetitionAt(double dance_frame) const;
  /// Returns the number, in the whole dance, of the first frame of `clip`, which must come from ClipLeaving or
  /// ClipReturning.
  std::size_t DanceFrameOf(int clip) const;
  /// Returns true if transitions return to the dance through this clip.
  bool IsReturning(int clip) const { return clip >= ClipReturning(-1); }
  bool IsLoop(int clip) const;

 private:
  Dance dance_;
  MotionLibrary library_;
  std::vector<std::size_t> dance_frames_;  // first dance frame of each ClipLeaving, then of each ClipReturning
};

}  // namespace etude
