#pragma once

#include "bench/model/payload.h"
#include "bench/tasks/tracking/run.h"
#include "bench/tasks/tracking/world.h"
#include "io/files/json.h"

namespace etude {

/// Describes what following a motion demands to methods outside the program, in the words of tree_json.h.
///
/// Setting, what built-in solvers stop at in each frame, and how far frames are apart:
///
///     {"rate_hz": 30, "max_steps": 20, "position_goal_cm": 0.1, "orientation_goal_deg": 0.1}
Payload DescribeTrackingSetting(const TrackingOptions& options, const IkOptions& common);

/// Makes the problem: the body, where to begin, and per frame its root and targets:
///
///     {"joints": […], "angles": […], "effectors": […], "start_angles_deg": [twenty-nine numbers],
///      "frames": [{"root": {"position_m": […], "rotation": […]}, "targets": [{"effector": "right_foot", …}, …]}, …]}
///
/// Asked for are angles for every frame as if the frames came one by one: nothing keeps a method from looking ahead but
/// its author's honesty.
Payload DescribeMotion(const TrackingWorld& world);

/// Makes the truth: the angles of the motion, per frame; itself a perfect answer unless targets are disturbed. Beside
/// it lies `truth.bvh`, the same for other programs.
///
///     {"angles_deg": [[twenty-nine numbers], …]}
Payload DescribeTrueAngles(const TrackingWorld& world);

/// Reads the answer of a method outside, one entry per frame:
///
///     {"angles_deg": [[twenty-nine numbers], …], "iterations": [4, 2, …]}
///
/// `iterations`, the method's own steps, may be left out; their metrics are then missing. Angles are taken as they are,
/// never moved into their limits: a frame with one that breaks a limit by more than 10⁻⁶ degrees is measured, and
/// counts as unsolved. Refused: what is not as told, and angles of more than a million degrees.
Result<TrackingAnswer> ReadTrackingAnswer(const Json& answer, const TrackingWorld& world);

}  // namespace etude
