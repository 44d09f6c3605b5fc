#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/motion/raw_motion.h"
#include "io/clips/open_clip.h"

namespace etude {

/// The name of the joint that is added if no joint of the file has the role of the hip centre.
constexpr const char* kMidwayHips = "(midway between the hips)";

/// Converts a clip to what its file holds: every frame at the file's own rate, on the file's own floor, with its gaps,
/// in metres and Y up. A leading T-pose stays. Of a skeleton it takes all joints; of markers, the joints that the
/// marker set determines and all other markers. Joints that a reader only estimates by a rule are left out. The hip
/// centre is midway between the hips, unless the file's own joint plays it. Contacts are read from an .npz that has them
/// (ReadFootContacts). Fails as UnderstandClip does: without roles, unit and up axis are unknown.
/// `keeps_rig`: bodies keep the rotations that RigClip made up.
Result<RawMotion> RawMotionOf(SourceClip source, const OpenOptions& options, bool keeps_rig = false);

/// Returns the digest of the bytes of the file that a reference names; of a built-in clip, that of its name. Files that
/// a file refers to (buffers of .gltf, skeletons of .amc) do not count. Fails if the file cannot be read.
Result<std::string> DigestOfFile(const std::string& reference, const OpenOptions& options);

/// Reads one motion: arrays of positions as they are (ReadRawNpz), any other as ReadOneClip does.
Result<RawMotion> OpenRawMotion(const std::string& reference, const OpenOptions& options);

}  // namespace etude
