#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/pose_distance/run.h"

namespace etude {

/// Describes the body to methods outside the program, which are told about pairs of poses. A pose is sixty numbers
/// (EncodePose).
///
/// Setting: the body.
///
///     {"joints": ["hip_centre", …], "parents": [null, "hip_centre", …]}
Payload BodyPayload();

/// Makes the problem: poses, two by two.
///
///     {"pairs": [{"a": [x, y, z, …], "b": [x, y, z, …]}, …]}
Payload PairsPayload(const PairWorld& world);

/// Makes the truth: how far the worst joint is off once heading and hips agree.
///
///     {"name": "arm forward or sideways", "pose_gap_cm": [103.2, …]}
Payload GapsPayload(const PairWorld& world);

/// Reads an answer: how unlike the two poses of each pair are, larger = more unlike, on any scale from 0 up; and
/// whether a transition from the one to the other would go unnoticed.
///
///     {"distances": [0.31, …], "alike": [true, …]}
///
/// Refuses what is not as told here, naming where in the answer.
Result<PairVerdict> ReadPairAnswer(const Json& answer, const PairWorld& world);

}  // namespace etude
