#pragma once

#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/formats/npz.h"
#include "engine/motion/clip.h"

namespace etude {

/// Returns SMPL's 22 body joints in their order, then five end sites, in Etude's own T-pose; metres, Z up.
Skeleton SmplSkeleton();

/// Reads a motion of AMASS (Mahmood et al. 2019) from its arrays: `poses` with 72 (SMPL), 156 (SMPL-H) or 165 (SMPL-X)
/// numbers per frame, the rotation vectors of the joints, also as frames × joints × 3; `trans` in metres, Z up; the
/// rate in `mocap_framerate`, `mocap_frame_rate` or another array of RateOfArrays. The clip has SMPL's 22 body joints;
/// fingers, jaw and eyes are left out. The licence forbids us to distribute the body model and its shapes, so limbs
/// have our own lengths, for a height of 1.70 m: rotations are those of the recorded person, but positions are not
/// accurate to the centimetre. Returns an error if arrays are missing or have another shape, if numbers are not finite,
/// or if the rate is missing or out of range. `told_hz` replaces the file's rate.
Result<Clip> ReadAmass(const Npz& npz, const std::string& file, std::optional<double> told_hz = std::nullopt,
                       std::vector<std::string>* remarks = nullptr);

}  // namespace etude
