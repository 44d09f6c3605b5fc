#pragma once

#include "bench/model/payload.h"
#include "bench/tasks/tracking/run.h"
#include "bench/tasks/tracking/world.h"
#include "io/files/json.h"

namespace etude {

/// Describes the condition to outside methods, in the format of tree_json.h. The setting holds the frame rate and the
/// goals at which built-in solvers stop in each frame:
///
///     {"rate_hz": 30, "max_steps": 20, "position_goal_cm": 0.1, "orientation_goal_deg": 0.1}
Payload DescribeTrackingSetting(const TrackingOptions& options, const IkOptions& common);

/// Encodes the problem. It holds the body, the start, and the root and the targets of each frame:
///
///     {"joints": […], "angles": […], "effectors": […], "start_angles_deg": [twenty-nine numbers],
///      "frames": [{"root": {"position_m": […], "rotation": […]}, "targets": [{"effector": "right_foot", …}, …]}, …]}
///
/// The method must find the angles of every frame as if the frames came one by one. This is only a convention: the
/// problem contains all frames, so a method could look ahead.
Payload DescribeMotion(const TrackingWorld& world);

/// Encodes the truth: the angles of the motion in each frame. The truth is a perfect answer unless targets are
/// disturbed. The file `truth.bvh` holds the same motion for other programs.
///
///     {"angles_deg": [[twenty-nine numbers], …]}
Payload DescribeTrueAngles(const TrackingWorld& world);

/// Reads the answer of an outside method, one entry per frame:
///
///     {"angles_deg": [[twenty-nine numbers], …], "iterations": [4, 2, …]}
///
/// `iterations` counts the method's own steps in each frame and is optional; without it, the metrics of iterations are
/// missing. Angles are never clamped to their limits: a frame that exceeds a limit by more than 10⁻⁶ degrees is
/// measured and counts as unsolved. Fails if the answer has a wrong shape, or if an angle exceeds a million degrees.
Result<TrackingAnswer> ReadTrackingAnswer(const Json& answer, const TrackingWorld& world);

}  // namespace etude
