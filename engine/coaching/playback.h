#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/coaching/dance.h"
#include "engine/transitions/library/library.h"
#include "engine/transitions/transition.h"

namespace etude {

/// A dance made ready for transitions, once for all who dance it: a library of its acts, its slow demonstrations, and,
/// for each repetition, what is danced around it.
class DanceLibrary {
 public:
  /// Refuses what CheckDance does.
  static Result<DanceLibrary> Make(Dance dance);

  const Dance& dance() const { return dance_; }
  const MotionLibrary& library() const { return library_; }

  /// Clips of the library.
  int ClipOfAct(std::string_view act) const;
  int ClipOfSlow(int move) const;
  /// What is left when a repetition is: from its first frame until a while after its end.
  int ClipLeaving(int repetition) const;
  /// What is entered when the dance goes back to a repetition: from a while before it to a while into it. The first
  /// stands for the song's beginning, too.
  int ClipReturning(int repetition) const;
  /// The frame of the dance that is a library clip's first; only of the last two.
  std::size_t DanceFrameOf(int clip) const;

 private:
  Dance dance_;
  MotionLibrary library_;
  std::vector<std::size_t> dance_frames_;
};

/// A transition that was spliced: what is shown after the frame of the request, to the wanted clip's end.
struct ShownPath {
  int clip = 0;                  ///< of the library: the wanted one
  std::vector<BodyPose> frames;  ///< in the place of the clip that was left
  std::size_t entered = 0;       ///< the first of `frames` that belongs to the wanted clip
  int first = 0;                 ///< the wanted clip's frame there
  FloorMove place;               ///< where the wanted clip is shown
  std::shared_ptr<const TransitionRecord> record;
};

/// Transitions within a dance by one way, each planned when it is first asked for and kept. What is answered does not
/// depend on what was asked before; not for several threads at once.
class DanceTransitions {
 public:
  /// `library` must outlive this.
  DanceTransitions(const DanceLibrary& library, TransitionWay way);

  const Dance& dance() const { return library_.dance(); }
  const DanceLibrary& library() const { return library_; }

  /// From a frame of a clip into another clip. A way without a transition there (it says why) cuts.
  std::shared_ptr<const ShownPath> Find(int from, int frame, int to) const;
  /// The same from a clip that stands at `place`, into a clip that is to stand where it was authored.
  std::shared_ptr<const ShownPath> FindHome(int from, int frame, const FloorMove& place, int to) const;

 private:
  const DanceLibrary& library_;
  TransitionWay way_;
  mutable std::map<std::array<int, 3>, std::shared_ptr<const ShownPath>> paths_;
};

/// What is being played.
struct Playback {
  std::shared_ptr<const ShownPath> path;  ///< a transition and the clip it leads into; null: the dance itself
  std::size_t path_frame = 0;             ///< the frame of `path` that is shown
  FloorMove place;                        ///< of the path
  double dance_frame = 0;                 ///< without a path
};

}  // namespace etude
