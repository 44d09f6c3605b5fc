#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "engine/coaching/dance_library.h"
#include "engine/transitions/choices/choice.h"

namespace etude {

/// The frames that are shown after a request: those of the transition, then those of the entered clip to its end. To
/// enter an act, a transition enters the clip of the act's beginning (DanceLibrary::ClipEntering); the whole act then
/// plays on. A floor move rotates a clip about the vertical and shifts it on the floor.
struct ShownPath {
  int clip = 0;                  ///< the wanted clip, as an index in the library
  std::vector<BodyPose> frames;  ///< shown poses, in the coordinates of the clip that played before
  std::size_t entered = 0;       ///< index in `frames` from which the wanted clip plays
  int clip_frame = 0;            ///< the frame of the wanted clip that is shown at index `entered`
  FloorMove place;               ///< the wanted clip's floor move, in the coordinates of `frames`
  /// Record of the transition; null if the path does not begin with one.
  std::shared_ptr<const TransitionRecord> record;
};

/// Plans the transitions within a dance by one method. Each transition is planned on its first use and cached. A result
/// depends only on the arguments, not on earlier calls. The class is not thread-safe.
class DanceTransitions {
 public:
  /// Plans the transitions of `library`, which must outlive this object.
  DanceTransitions(const DanceLibrary& library, TransitionWay way);

  const DanceLibrary& library() const { return library_; }
  const Dance& dance() const { return library_.dance(); }

  /// Returns a path that shows only the clip `clip`, at the place on the floor where it was authored.
  std::shared_ptr<const ShownPath> Alone(int clip) const;
  /// Returns the path from a frame of a clip into another clip. If the method finds no transition, the path is a cut.
  std::shared_ptr<const ShownPath> Find(int from, int frame, int to) const;
  /// Returns the path from a frame of a clip with floor move `place` into another clip, which is shown where it was
  /// authored. Rotations and shifts therefore do not accumulate over many transitions.
  std::shared_ptr<const ShownPath> FindHome(int from, int frame, const FloorMove& place, int to) const;

 private:
  std::shared_ptr<const TransitionRecord> Plan(int from, int frame, int to) const;
  /// `home_from` is null if the wanted clip may be shown anywhere on the floor. Otherwise it is shown where it was
  /// authored, and `home_from` is the floor move of the playing clip.
  std::shared_ptr<const ShownPath> Splice(int from, int frame, const FloorMove* home_from, int to) const;

  const DanceLibrary& library_;
  TransitionWay way_;
  mutable std::map<std::array<int, 3>, std::shared_ptr<const TransitionRecord>> plans_;
  mutable std::map<std::array<int, 3>, std::shared_ptr<const ShownPath>> paths_;
};

/// The current state of playing: the dance itself, or a path (a transition and the clip it leads into).
struct Playback {
  std::shared_ptr<const ShownPath> path;  ///< the path that is shown; null while the dance itself plays
  double path_frame = 0;  ///< frames since the path began, in its transition and in its clip; fractional
  FloorMove place;                        ///< floor move of the path
  double dance_frame = 0;                 ///< index of the shown frame of the dance; used only if `path` is null
};

/// The clip that a path plays, and the shown frame of this clip; during a transition, the wanted clip and the first of
/// its frames that will be shown.
struct PlayedClip {
  int clip = 0;
  double frame = 0;
  bool in_transition = false;
};

/// Returns the clip that the path plays, and the frame of this clip that is shown. `playback.path` must not be null.
PlayedClip PlayedOf(const Playback& playback, const DanceLibrary& library);
/// Returns the shown frame of the dance; −1 if something else is shown.
double DanceFrame(const Playback& playback, const DanceLibrary& library);
/// Returns the pose that is shown.
BodyPose ShownPose(const Playback& playback, const DanceLibrary& library);
/// Returns true if the dance or the path's clip has ended or ends within `before` frames; always false for a loop.
bool IsOver(const Playback& playback, const DanceLibrary& library, double before = 0);

/// Returns true if the playing clip may be left: no join is in progress, and the frames of the clip itself are shown.
bool IsSettled(const Playback& playback);

/// Advances by one frame, or by `rate` frames of the dance while the dance plays. When a path back into the dance has
/// ended, the dance continues from the frame that the path has reached.
void Advance(Playback& playback, const DanceLibrary& library, double rate);
/// Starts a transition from the playing dance or clip to the clip `clip`, beginning with the next frame.
/// `IsSettled(playback)` must be true.
void LeaveFor(int clip, Playback& playback, const DanceTransitions& transitions);
/// Starts a transition like LeaveFor, but shows the clip at the place on the floor where it was authored.
void LeaveForHome(int clip, Playback& playback, const DanceTransitions& transitions);

}  // namespace etude
