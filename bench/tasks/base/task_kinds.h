#pragma once

#include "bench/tasks/base/task.h"

namespace etude {

// These functions return the kinds of tasks. Each kind is made in its own folder, in the file `NAME_task.cc`.

/// Task transition asks how smoothly a body gets from one clip into another on request. A world has two clips of the
/// library and the time at which the second one is requested.
TaskKind MakeTransitionTaskKind();
/// Task detection asks if the coach notices which moves were performed right, and how soon. A world is a learner's
/// session of right and wrong performances of built-in moves, seen by a Kinect-like sensor.
TaskKind MakeDetectionTaskKind();
/// Task ik is inverse kinematics on paper B's body, starting from a disturbed pose. It measures how close the end
/// effectors come to their targets, and the errors of the hidden angles (paper B, chapter 5).
TaskKind MakeIkTaskKind();
/// Task tracking is inverse kinematics along clips. It measures if a solver keeps up with a motion when it has a
/// limited number of steps per frame and starts at its answer to the previous frame.
TaskKind MakeTrackingTaskKind();
/// Task capture measures how close the skeleton from two or more cameras comes to the truth. It runs paper B's whole
/// pipeline on rendered pictures of a clip.
TaskKind MakeCaptureTaskKind();
/// Task pose-distance measures how well a distance tells whether two poses look alike. A world is one of eight authored
/// pairs of poses, or some hundreds of pairs of frames of two clips.
TaskKind MakePoseDistanceTaskKind();
TaskKind MakeCoachTaskKind();
/// Task evaluation measures how close motions in files come to their truths in other files.
TaskKind MakeEvaluationTaskKind();
/// Task plausibility measures if a person could have moved like the motions in files.
TaskKind MakePlausibilityTaskKind();
/// Task inbetween measures how well hidden frames of a motion are filled in. A world is a series of consecutive frames
/// from a motion file, in the middle of which some frames are hidden.
TaskKind MakeInbetweenTaskKind();

}  // namespace etude
