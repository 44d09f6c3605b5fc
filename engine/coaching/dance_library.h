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
  /// The whole clip of an act of the dance, and that of a slow demonstration: clips to be left.
  int ClipOfAct(std::string_view act) const;
  int ClipOfSlow(int move) const;
  /// The clip to be left at a frame between this repetition and a while into the next one; the last one's reaches to
  /// the song's end.
  int ClipLeaving(int repetition) const;
  /// The clip of the beginning of a whole act or slow demonstration: transitions enter it, so that they cannot skip the
  /// main part.
  int ClipEntering(int whole) const;
  /// The clip of the dance that is entered to go (back) to a repetition: from a while before it to a while into it.
  int ClipReturning(int repetition) const;

  /// The clip that is played on once this one was entered: the whole one of a beginning.
  int WholeOf(int clip) const;
  /// The repetition that has begun last at a frame of the dance; −1 before the first.
  int RepetitionAt(double dance_frame) const;
  /// The frame of the dance that is the first of a clip that is left or returned to.
  std::size_t DanceFrameOf(int clip) const;
  /// Says whether the dance is returned to through this clip.
  bool IsReturning(int clip) const { return clip >= ClipReturning(-1); }
  bool IsLoop(int clip) const;

 private:
  Dance dance_;
  MotionLibrary library_;
  std::vector<std::size_t> dance_frames_;  // of the clips that are left, then of those returned to
};

}  // namespace etude
