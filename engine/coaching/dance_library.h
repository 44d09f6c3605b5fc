#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/coaching/dance.h"
#include "engine/transitions/library/library.h"

namespace etude {

/// A dance made ready for transitions, once for all who dance it: a library of its acts, its slow demonstrations, and
/// of what is danced around each repetition.
class DanceLibrary {
 public:
  /// Refuses what CheckDance does.
  static Result<DanceLibrary> Make(Dance dance);

  const Dance& dance() const { return dance_; }
  const MotionLibrary& library() const { return library_; }

  // Clips of the library. `repetition` -1 stands for the song's beginning.
  /// An act, which must be one of the dance's; a slow demonstration. Whole, to be left.
  int ClipOfAct(std::string_view act) const;
  int ClipOfSlow(int move) const;
  /// What is left at a frame from this repetition on, until the next one and a while into it; the last one's reaches to
  /// the song's end.
  int ClipLeaving(int repetition) const;
  /// How an act or a slow demonstration, given whole, begins: what is entered, so that no transition skips what it is
  /// about.
  int ClipEntering(int whole) const;
  /// Likewise of the dance, when it goes (back) to a repetition: from a while before it to a while into it.
  int ClipReturning(int repetition) const;

  /// What is played on once this clip was entered: of a beginning, the whole.
  int WholeOf(int clip) const;
  /// The repetition that has begun last at a frame of the dance; −1 before the first.
  int RepetitionAt(double dance_frame) const;
  /// The frame of the dance that is the first of a clip that is left or returned to.
  std::size_t DanceFrameOf(int clip) const;
  /// Whether a clip is one that is returned to.
  bool IsReturning(int clip) const { return clip >= ClipReturning(-1); }
  bool IsLoop(int clip) const;

 private:
  Dance dance_;
  MotionLibrary library_;
  std::vector<std::size_t> dance_frames_;  // of the clips that are left, then of those returned to
};

}  // namespace etude
