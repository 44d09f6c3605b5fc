#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "engine/coaching/dance_library.h"
#include "engine/transitions/choices/choice.h"

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

/// Plans the transitions within a dance by one way. Each is planned when it is first asked for, and kept: an answer
/// does not depend on what was asked before. Not for several threads at once.
class DanceTransitions {
 public:
  /// Plans for `library`, which must outlive this.
  DanceTransitions(const DanceLibrary& library, TransitionWay way);

  const DanceLibrary& library() const { return library_; }
  const Dance& dance() const { return library_.dance(); }

  /// Returns a path of the clip alone, where it was authored.
  std::shared_ptr<const ShownPath> Alone(int clip) const;
  /// Returns the path from a frame of a clip into another clip. Where the way finds no transition, it cuts.
  std::shared_ptr<const ShownPath> Find(int from, int frame, int to) const;
  /// Does the same from a clip that is laid at `place` into one that is shown where it was authored, so that turns and
  /// shifts do not add up.
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

/// The thing that is being played: the dance itself, or a path (a transition and the clip it leads into).
struct Playback {
  std::shared_ptr<const ShownPath> path;  ///< null: the dance
  double path_frame = 0;                  ///< in the path and on in its clip, between two frames, too
  FloorMove place;                        ///< where the path is laid
  double dance_frame = 0;                 ///< without a path
};

/// The clip that plays, and where in it; in a transition, the wanted one's first frame.
struct PlayedClip {
  int clip = 0;
  double frame = 0;
  bool in_transition = false;
};

/// Returns which clip a path plays, and where in it. `playback.path` must not be null.
PlayedClip PlayedOf(const Playback& playback, const DanceLibrary& library);
/// Returns the frame of the dance that is shown, −1 when none is.
double DanceFrame(const Playback& playback, const DanceLibrary& library);
/// Returns the body that is shown.
BodyPose ShownPose(const Playback& playback, const DanceLibrary& library);
/// Says whether a path has come to the end of its clip, or so many frames before it; never in a clip that loops.
bool IsOver(const Playback& playback, const DanceLibrary& library, double before = 0);

/// Says whether it may be left: no join is under way, and the clip itself is shown.
bool IsSettled(const Playback& playback);

/// Advances by one frame; in the dance by `rate` of them. A path back to the dance ends in the dance.
void Advance(Playback& playback, const DanceLibrary& library, double rate);
/// Leaves what is played, which must be settled, for a clip, from the next frame on.
void LeaveFor(int clip, Playback& playback, const DanceTransitions& transitions);
/// Leaves it for a clip that is to stand where it was authored.
void LeaveForHome(int clip, Playback& playback, const DanceTransitions& transitions);

}  // namespace etude
