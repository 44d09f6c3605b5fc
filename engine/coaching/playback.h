#pragma once

#include <memory>

#include "engine/coaching/dance_transitions.h"

namespace etude {

/// What is being played: the dance itself, or a path (a transition and the clip it leads into).
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

/// Of a path: what its clip is, and where. `playback.path` must be one.
PlayedClip PlayedOf(const Playback& playback, const DanceLibrary& library);
/// The frame of the dance that is shown; −1: none.
double DanceFrame(const Playback& playback, const DanceLibrary& library);
/// The body that is shown.
BodyPose ShownPose(const Playback& playback, const DanceLibrary& library);
/// Whether a path has come to the end of its clip, or so many frames before it; never in a clip that loops.
bool IsOver(const Playback& playback, const DanceLibrary& library, double before = 0);

/// Whether it may be left: no join is under way, so that what is shown is the clip itself.
bool IsSettled(const Playback& playback);

/// Goes on by one frame; in the dance by `rate` of them. A path back to the dance ends in the dance.
void Advance(Playback& playback, const DanceLibrary& library, double rate);
/// Leaves what is played, which must be settled, for a clip, from the next frame on.
void LeaveFor(int clip, Playback& playback, const DanceTransitions& transitions);
/// Likewise for a clip that is to stand where it was authored.
void LeaveForHome(int clip, Playback& playback, const DanceTransitions& transitions);

}  // namespace etude
