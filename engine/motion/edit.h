#pragma once

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// The clip at another rate: SampleClip at k / rate_hz, from the first frame to the last that still lies within the
/// clip. The first frame stays as it is; at the same rate nothing changes. `rate_hz` > 0.
Clip Resample(const Clip& clip, double rate_hz);

/// The frames of [from_s, to_s], seconds from the first frame; the nearest frame to either end is kept. Refused: a
/// range that holds no frame or does not lie within the clip.
Result<Clip> Trim(const Clip& clip, double from_s, double to_s);

/// The mirror image of a clip: every transform is reflected in the plane x = 0, and joints named for one side get the
/// other's name ("LeftArm" ↔ "RightArm", "upperarm.l" ↔ "upperarm.r", "L_Elbow", "lShldr", "Bip01 L Thigh"). Twice is
/// the clip itself.
Clip Mirror(const Clip& clip);
/// The same of twenty joints: roles change sides.
BodyMotion Mirror(const BodyMotion& motion);

/// The same motion without scales, for formats that have none (BVH): joints stay exactly where they are in the world,
/// translations may then change from frame to frame; rotations are those nearest to the scaled axes.
Clip WithoutScales(const Clip& clip);

}  // namespace etude
