#pragma once

#include <map>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/retargeting/joint_map.h"

namespace etude {

/// What a joint-map file says: which joint plays a role. Roles that it leaves out are found as usual.
struct TaughtRoles {
  std::map<Role, std::string> joints;  ///< the joint's name as the clip has it; "LeftHand_End" for BVH's End Sites
  Place place;                         ///< for complaints
};

/// Reads a joint-map file (docs/clips.md):
///     roles:
///       left_shoulder: LShldr
///       left_elbow: LForeArm
Result<TaughtRoles> ReadJointMapFile(std::string_view yaml, const std::string& file);

/// Writes what was found as such a file, with the composed roles and unused joints as comments: a start for one's own.
std::string WriteJointMapFile(const Skeleton& skeleton, const JointMap& map);

}  // namespace etude
