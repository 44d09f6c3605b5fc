#pragma once

#include <vector>

#include "bench/model/payload.h"
#include "bench/tasks/inbetween/score.h"

namespace etude {

/// Encodes the problem of a gap: the frames before the gap and `given` frames after it, on the joint tree of their
/// file. A pose is a list of numbers: the root's position in metres (Y up), then each joint's rotation in its parent's
/// frame as a unit quaternion (w, x, y, z).
///
///     {"rate_hz": 30, "joints": ["Hips", …], "parents": [-1, 0, …], "offsets_m": [[x, y, z], …], "gap": 30,
///      "past": [[x, y, z, w, x, y, z, …], …], "future": [likewise]}
Payload GapPayload(const HiddenWindow& hidden, int given);

/// Encodes the true frames of the gap, in the form of an answer:
///
///     {"frames": [[x, y, z, w, x, y, z, …], …]}
Payload HiddenPayload(const HiddenWindow& hidden);

/// Reads an answer, which must have as many frames as are hidden. A quaternion's length may differ from 1 by at most
/// 0.01; the quaternion is then normalised. Fails on any other answer, naming the position in it.
Result<std::vector<TreePose>> ReadFrames(const Json& answer, const HiddenWindow& hidden);

}  // namespace etude
