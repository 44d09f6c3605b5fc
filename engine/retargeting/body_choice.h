#pragma once

#include <set>
#include <string>

#include "engine/base/result.h"
#include "engine/motion/clip.h"
#include "engine/retargeting/joint_map.h"

namespace etude {

/// The body of a clip that is used, if the clip's skeleton contains several.
struct BodyChoice {
  JointMap map;
  std::string doubt = "";  ///< a text for users about the bodies that are left out; "" if there are none
};

/// Finds the bodies in a clip's skeleton (FindJointMap), and chooses the one that moves in this clip: a joint between
/// the body's joints with roles turns or slides. Of several that move, or if none moves, a body of `skinned` joints is
/// chosen; of several of these, the first. A body with joints in `taught` is always chosen. `skinned` names the joints
/// that the file declares as parts of a skeleton: joints of glTF's skins, FBX's LimbNodes. Fails like FindJointMap if
/// there is no body.
Result<BodyChoice> ChooseBody(const Clip& clip, const std::string& file, const JointMapOverrides* taught = nullptr,
                              const std::set<std::string>& skinned = {});

}  // namespace etude
