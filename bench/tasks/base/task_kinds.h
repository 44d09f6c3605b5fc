#pragma once

#include "bench/tasks/base/task.h"

namespace etude {

// The kinds of tasks; each is made in its own folder, `NAME_task.cc`.

/// How smoothly does a body get from one clip into another on request? One world: two clips of the library and the time
/// at which the second is requested.
TaskKind MakeTransitionTaskKind();
/// Does the coach notice which moves were performed right, and how soon? One world: a learner's session of built-in
/// moves, right and wrong, as a Kinect-like sensor saw it.
TaskKind MakeDetectionTaskKind();
/// Inverse kinematics on paper B's body: how close do the end effectors come to their targets, and how far are the
/// hidden angles off, starting from a disturbed pose (paper B, chapter 5)?
TaskKind MakeIkTaskKind();
/// Inverse kinematics along clips: does a solver keep up with a motion if it has a limited number of steps per frame
/// and starts at its answer to the frame before?
TaskKind MakeTrackingTaskKind();
/// How close does the skeleton from two cameras come to the truth? Paper B's whole pipeline on rendered pictures of a
/// clip.
TaskKind MakeCaptureTaskKind();
/// How well does a distance measure show whether two poses look alike? One world: one of eight authored pairs of poses,
/// or some hundreds of pairs of frames of two clips.
TaskKind MakePoseDistanceTaskKind();
TaskKind MakeCoachTaskKind();
/// How close do the motions of files come to their truths in other files?
TaskKind MakeEvaluationTaskKind();
/// Could a person have moved as the motions of files do?
TaskKind MakePlausibilityTaskKind();
/// How well are hidden frames of a motion filled in? One world: a window of a file.
TaskKind MakeInbetweenTaskKind();

}  // namespace etude
