#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/motion/raw_motion.h"
#include "io/clips/open_clip.h"

namespace etude {

/// Converts a clip to what its file holds: every frame at the file's own rate, on the file's own floor, with its gaps,
/// in metres and Y up. A leading T-pose stays. Of a skeleton it takes all joints; of markers, the joints that the
/// marker set determines and all other markers. Joints that a reader only estimates by a rule are left out. The hip
/// centre is the file's own: the joint that carries both hips, unless it is not named so and lies further than 0.4
/// thigh lengths from their middle at rest (an OpenNI torso does); else it is midway between the hips (AddMidwayHips).
/// Contacts are read from an .npz that has them (ReadFootContacts). Fails as UnderstandClip does: without roles, unit
/// and up axis are unknown. `keeps_rig`: bodies keep the rotations that RigClip made up.
Result<RawMotion> RawMotionOf(SourceClip source, const OpenOptions& options, bool keeps_rig = false);

/// Returns the digest of the bytes of the file that a reference names; of a built-in clip, that of its name. Files that
/// a file refers to (buffers of .gltf, skeletons of .amc) do not count. Fails if the file cannot be read.
Result<std::string> DigestOfFile(const std::string& reference, const OpenOptions& options);

/// Reads one motion: arrays of positions by ReadRawNpz, any other as ReadOneClip does. `keeps_rig` as in RawMotionOf.
Result<RawMotion> OpenRawMotion(const std::string& reference, const OpenOptions& options, bool keeps_rig = false);

}  // namespace etude
