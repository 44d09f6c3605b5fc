#pragma once

#include "bench/tasks/base/task.h"

namespace etude {

// The kinds of tasks; each is made in its own folder, `NAME_task.cc`.

/// "How smoothly does a body get from one clip into another when called?" One world: two clips of the
/// library and the moment at which the second is asked for.
TaskKind MakeTransitionTaskKind();
/// "Does the coach notice which moves were performed right, and how soon?" One world: a learner's session
/// of built-in moves, right and wrong, and what a Kinect-like sensor saw of it.
TaskKind MakeDetectionTaskKind();
/// Inverse kinematics on paper B's body: how near do the end effectors come to their targets, and how far do the hidden
/// angles stray, from a disturbed pose (paper B, chapter 5)?
TaskKind MakeIkTaskKind();
/// Inverse kinematics along clips: does a solver keep up with a motion when a frame has only so many steps, and each
/// begins at the answer to the one before?
TaskKind MakeTrackingTaskKind();
/// "How close does the skeleton from two cameras come to the truth?": paper B's whole pipeline on rendered
/// pictures of a clip.
TaskKind MakeCaptureTaskKind();
/// The task `search`: how does finding matching frames grow with the library?
TaskKind MakeSearchTaskKind();
/// "How well does a distance know that two poses look alike?" One world: one of eight authored pairs of poses, or some
/// hundreds of pairs of frames of two clips.
TaskKind MakePoseDistanceTaskKind();
TaskKind MakeCoachTaskKind();

}  // namespace etude
