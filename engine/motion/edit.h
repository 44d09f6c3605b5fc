#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// Resamples a clip: returns its poses (SampleFrame) at the times k / rate_hz seconds after the first frame, k = 0, 1,
/// …, up to the clip's end. The first frame is unchanged; at the clip's own rate nothing changes. `rate_hz` > 0; the
/// clip must have at least one frame.
Clip Resample(const Clip& clip, double rate_hz);

/// Returns the frames from `from_s` to `to_s`, seconds from the first frame, ends included. Both ends are rounded to
/// the nearest frame. Fails if the range ends before it begins, or if it is not within the clip.
Result<Clip> Trim(const Clip& clip, double from_s, double to_s);

/// Returns the mirror image of a clip: every transform is reflected in the plane x = 0, and joints whose names state a
/// side get the other side's name (WithSidesSwapped). Mirroring twice returns the clip itself.
Clip Mirror(Clip clip);
/// Returns the mirror image of a motion of the twenty joints: left and right roles are exchanged.
BodyMotion Mirror(const BodyMotion& motion);

/// Returns the motion without scales, for formats that have none (BVH). Joints keep their positions in the world, so
/// translations may change from frame to frame. Each joint's new rotation is the rotation nearest to the joint's scaled
/// axes (polar decomposition); a joint whose axes are flattened or mirrored keeps its own rotation.
Clip WithoutScales(Clip clip);

/// Returns the motion on a skeleton without rotations at rest: every joint's axes at rest are the world's, as in BVH.
/// Joints keep their positions in the world, in every frame and at rest. Scales must be 1.
Clip WithWorldAxesAtRest(Clip clip);

/// Returns the motion with a single root. Several roots become children of a new joint that stays at the origin.
Clip WithOneRoot(Clip clip);

/// Returns the motion on a skeleton whose root is the joint with index `joint`: along the path from `joint` to the old
/// root, parents become children; all other joints keep their parents. Joints keep their positions in the world, in
/// every frame and at rest. Scales must be 1.
Clip WithRootAt(const Clip& clip, int joint);

/// Returns a joint's name with its first word for a side exchanged: "LeftArm" ↔ "RightArm", "upperarm.l" ↔
/// "upperarm.r", "L_Elbow", "lShldr", "Bip01 L Thigh", "mixamorig:LeftArm". Words end at punctuation, blanks and
/// capital letters; the part before a colon is ignored. Other names are returned unchanged: "Collar", "lowerback",
/// "L5".
std::string OtherSide(std::string_view name);

/// Renames every joint to its OtherSide. A side without a word boundary ("lfemur", "leftarm", "L5") counts only if the
/// skeleton also has a joint with the other side's name; otherwise the letter belongs to the word ("lumbar") or numbers
/// a vertebra ("L5"). Two calls return the original skeleton.
Skeleton WithSidesSwapped(Skeleton skeleton);

}  // namespace etude
