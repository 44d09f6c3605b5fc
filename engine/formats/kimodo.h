#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/npz.h"
#include "engine/motion/clip.h"

namespace etude {

/// Returns true if the arrays are a motion that Kimodo (nv-tlabs/kimodo) generated.
bool IsKimodoNpz(const Npz& arrays);

/// Reads `posed_joints` (frames × joints × 3, metres, Y up) and `global_rot_mats` (frames × joints × 3 × 3) on Kimodo's
/// skeletons somaskel30 and somaskel77, and on SMPL-X's 22 body joints; their rotations are the identity in the T-pose.
/// Bones have the lengths of the first frame. The rate is `told_hz`, or else what the arrays state (EvenRateOf), or
/// else the model's 30 Hz, which `remarks` then states. Fails for other shapes, values that are not finite, and
/// matrices that are not rotations.
Result<Clip> ReadKimodo(const Npz& arrays, const std::string& file, std::optional<double> told_hz,
                        std::vector<std::string>& remarks);

/// Returns `foot_contacts` (frames × 4: left heel, left toes, right heel, right toes; 0 or 1); nullopt if there is no
/// such array. The file need not be Kimodo's. Fails for another shape.
Result<std::optional<std::vector<bool>>> ReadFootContacts(const Npz& arrays, std::size_t frames,
                                                          const std::string& file);

}  // namespace etude
