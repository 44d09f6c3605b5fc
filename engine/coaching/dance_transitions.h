#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "engine/coaching/dance_library.h"
#include "engine/transitions/transition.h"

namespace etude {

/// A transition as it is shown after the frame of the request, until the wanted clip plays alone.
struct ShownPath {
  int clip = 0;                                    ///< of the library: the wanted one
  std::vector<BodyPose> frames;                    ///< where the clip that was left stands
  std::size_t entered = 0;                         ///< the first of `frames` in which the wanted clip plays
  int clip_frame = 0;                              ///< the wanted clip's frame there
  FloorMove place;                                 ///< where the wanted clip is laid
  std::shared_ptr<const TransitionRecord> record;  ///< null: nothing was left
};

/// Transitions within a dance by one way. Each is planned when it is first asked for, and kept: an answer does not
/// depend on what was asked before. Not for several threads at once.
class DanceTransitions {
 public:
  /// `library` must outlive this.
  DanceTransitions(const DanceLibrary& library, TransitionWay way);

  const DanceLibrary& library() const { return library_; }
  const Dance& dance() const { return library_.dance(); }

  /// Nothing but the clip, where it was authored.
  std::shared_ptr<const ShownPath> Alone(int clip) const;
  /// From a frame of a clip into another clip. Where the way has none, it is cut.
  std::shared_ptr<const ShownPath> Find(int from, int frame, int to) const;
  /// The same from a clip that is laid at `place`, into one that is shown where it was authored: paths accumulate no
  /// turns and shifts.
  std::shared_ptr<const ShownPath> FindHome(int from, int frame, const FloorMove& place, int to) const;

 private:
  std::shared_ptr<const TransitionRecord> Plan(int from, int frame, int to) const;
  /// `home_from`: null, or where the playing clip is laid, when the wanted one is to be shown where it was authored.
  std::shared_ptr<const ShownPath> Splice(int from, int frame, const FloorMove* home_from, int to) const;

  const DanceLibrary& library_;
  TransitionWay way_;
  mutable std::map<std::array<int, 3>, std::shared_ptr<const TransitionRecord>> plans_;
  mutable std::map<std::array<int, 3>, std::shared_ptr<const ShownPath>> paths_;
};

}  // namespace etude
