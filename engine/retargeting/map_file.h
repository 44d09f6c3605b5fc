#pragma once

#include <map>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/retargeting/joint_map.h"

namespace etude {

/// A joint as a joint-map file names it.
struct TaughtJoint {
  std::string name;  ///< as the clip has it; "LeftHand_End" for BVH's End Sites
  Place place;       ///< for complaints
};

/// The contents of a joint-map file: which joint plays a role. Roles that it leaves out are found as usual.
struct TaughtRoles {
  std::map<Role, TaughtJoint> joints;
};

/// Reads a joint-map file (docs/clips.md):
///     roles:
///       left_shoulder: LShldr
///       left_elbow: LForeArm
/// Refused, with line and column: unknown roles, values that are no names, no roles at all.
Result<TaughtRoles> ReadJointMapFile(std::string_view yaml, const std::string& file);

/// Writes what was found as such a file, with the composed roles and unused joints as comments: a start for one's own.
/// Read back, it gives the same map.
std::string WriteJointMapFile(const Skeleton& skeleton, const JointMap& map);

}  // namespace etude
