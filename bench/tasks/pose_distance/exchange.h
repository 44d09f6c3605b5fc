#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/pose_distance/run.h"

namespace etude {

/// Describes the body to outside methods, which judge pairs of poses. A pose is sixty numbers (EncodePose).
///
/// The setting is the body:
///
///     {"joints": ["hip_centre", …], "parents": [null, "hip_centre", …]}
Payload BodyPayload();

/// Encodes the problem, which is a list of pairs of poses:
///
///     {"pairs": [{"a": [x, y, z, …], "b": [x, y, z, …]}, …]}
Payload PairsPayload(const PairWorld& world);

/// Encodes the truth: for each pair, the largest joint distance after headings and hips are aligned.
///
///     {"name": "arm forward or sideways", "pose_gap_cm": [103.2, …]}
Payload GapsPayload(const PairWorld& world);

/// Reads an answer. For each pair, `distances` is the distance of the two poses on any scale from 0 up (larger = less
/// alike). `alike` is true if the two poses look so alike that nobody would notice a transition between them.
///
///     {"distances": [0.31, …], "alike": [true, …]}
///
/// Fails on an answer of another form, naming the position in it.
Result<PairVerdict> ReadPairAnswer(const Json& answer, const PairWorld& world);

}  // namespace etude
