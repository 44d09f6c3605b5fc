#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// Returns the clip at another rate: its poses at k / rate_hz (SampleFrame), from the first frame to the last that
/// still lies within the clip. The first frame stays as it is; at the same rate nothing changes. `rate_hz` > 0; needs
/// at least one frame.
Clip Resample(const Clip& clip, double rate_hz);

/// Cuts out the frames of [from_s, to_s], seconds from the first frame; the nearest frame to either end is kept.
/// Refused: a range that ends before it begins, or whose nearest frames do not lie within the clip.
Result<Clip> Trim(const Clip& clip, double from_s, double to_s);

/// Returns the mirror image of a clip: every transform is reflected in the plane x = 0, and joints named for one side
/// get the other's name (WithSidesSwapped). Twice is the clip itself.
Clip Mirror(Clip clip);
/// Returns the mirror image of a motion of the twenty joints: roles change sides.
BodyMotion Mirror(const BodyMotion& motion);

/// Returns the same motion without scales, for formats that have none (BVH): joints stay exactly where they are in the
/// world, translations may then change from frame to frame. Rotations are those nearest to the scaled axes (their polar
/// part); a joint whose axes are flattened or mirrored keeps the rotation it has of its own.
Clip WithoutScales(Clip clip);

/// Returns the same motion of a skeleton whose rest pose has no rotations: every joint's axes are the world's when it
/// rests, as in BVH. Joints stay where they are in the world, in every frame and at rest. Needs unit scales.
Clip WithWorldAxesAtRest(Clip clip);

/// Returns the same motion with a single root: several come under one that stands still at the origin.
Clip WithOneRoot(Clip clip);

/// Returns the same motion of a skeleton whose root is `joint`, by index: the joints on the way from it to the old root
/// change their order, all others stay under their parents. Joints are where they were in the world, in every frame and
/// at rest. Needs unit scales.
Clip WithRootAt(const Clip& clip, int joint);

/// Returns a joint's name with its first word for a side changed: "LeftArm" ↔ "RightArm", "upperarm.l" ↔ "upperarm.r",
/// "L_Elbow", "lShldr", "Bip01 L Thigh", "mixamorig:LeftArm". Words end at signs, blanks and where capitals begin; what
/// stands in front of a colon is not looked at. Other names come back as they are: "Collar", "lowerback", "L5".
std::string OtherSide(std::string_view name);

/// Renames every joint to its OtherSide. A side glued to the name ("lfemur", "leftarm", "L5") is one only when the
/// skeleton has the other name too: else it is a word that begins alike, or a vertebra. Twice is the skeleton itself.
Skeleton WithSidesSwapped(Skeleton skeleton);

}  // namespace etude
