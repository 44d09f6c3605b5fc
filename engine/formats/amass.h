#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/formats/npz.h"
#include "engine/motion/clip.h"

namespace etude {

/// Reads a motion of AMASS (Mahmood et al. 2019) out of its arrays: `poses` of 72 numbers a frame (SMPL), 156 (SMPL-H) or
/// 165 (SMPL-X), turns of joints as axis times angle; `trans`, metres, Z up; `mocap_framerate` or `mocap_frame_rate`. The
/// clip has SMPL's 22 joints of the body; fingers, jaw and eyes are left out. The model and its shapes may not be
/// shipped: limbs have our own lengths, of somebody of 1.70 m, so that turns are the recorded person's and places are
/// not to the centimetre. Refused: arrays that lack, or are of another shape, numbers that are not finite, rates that
/// are no rate.
Result<Clip> ReadAmass(const Npz& arrays, const std::string& file);

}  // namespace etude
