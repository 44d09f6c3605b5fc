#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/pose_distance/run.h"

namespace etude {

/// Describes the body to outside methods, which are asked about pairs of poses. A pose is sixty numbers (EncodePose).
///
/// Setting: the body.
///
///     {"joints": ["hip_centre", …], "parents": [null, "hip_centre", …]}
Payload BodyPayload();

/// Encodes the problem: pairs of poses.
///
///     {"pairs": [{"a": [x, y, z, …], "b": [x, y, z, …]}, …]}
Payload PairsPayload(const PairWorld& world);

/// Encodes the truth: the distance of the worst joint after aligning headings and hips.
///
///     {"name": "arm forward or sideways", "pose_gap_cm": [103.2, …]}
Payload GapsPayload(const PairWorld& world);

/// Reads an answer: the distance of the two poses of each pair, on any scale from 0 up, larger = less alike; and
/// whether the two poses look alike, so that a transition between them would not be noticed.
///
///     {"distances": [0.31, …], "alike": [true, …]}
///
/// An answer of another form is an error that names the position in it.
Result<PairVerdict> ReadPairAnswer(const Json& answer, const PairWorld& world);

}  // namespace etude
