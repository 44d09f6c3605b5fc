#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/motion/raw_motion.h"
#include "io/clips/open_clip.h"

namespace etude {

/// Returns the motion as the file of a clip holds it: every frame at the file's own rate, on the file's own floor, with
/// its gaps, in metres and Y up. A leading T-pose stays. A skeleton gives all its joints; markers give all markers and
/// the joints that the marker set determines (MarkerBody::shown). Joints that a reader guesses by a rule are left out.
/// The hip centre is the joint from which both hips branch if the user's roles name a hip centre, if this joint has the
/// name of a pelvis, or if it lies within 0.4 thigh lengths of the hips' middle at rest. Otherwise, as for an OpenNI
/// torso, the hip centre is midway between the hips (AddMidwayHips). Contacts are read from an .npz that has them
/// (ReadFootContacts). Fails if UnderstandClip fails, because without roles the unit and the up axis are unknown. With
/// `keeps_rig`, bodies keep the rotations that RigClip computed.
Result<RawMotion> RawMotionOf(SourceClip source, const OpenOptions& options, bool keeps_rig = false);

/// Returns the digest of the bytes of the file that a reference names; for a built-in clip, the digest of its name.
/// Files to which that file refers (buffers of .gltf, skeletons of .amc) are not included. Fails if the file cannot be
/// read.
Result<std::string> DigestOfFile(const std::string& reference, const OpenOptions& options);

/// Reads one motion. Arrays of positions are read by ReadRawNpz if their joints' names state a joint for every needed
/// role, or if ReadOneClip finds no body in them; everything else is read by ReadOneClip. Markers of no known set
/// become joints without roles, and the notes state why. `keeps_rig` has the same meaning as in RawMotionOf.
Result<RawMotion> OpenRawMotion(const std::string& reference, const OpenOptions& options, bool keeps_rig = false);

}  // namespace etude
