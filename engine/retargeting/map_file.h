#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/orientation.h"

namespace etude {

/// A joint as a joint-map file names it.
struct TaughtJoint {
  std::string name;  ///< as the clip has it; "LeftHand_End" for BVH's End Sites
  Place place;       ///< for complaints
};

/// The contents of a joint-map file: which joint plays a role, and other facts about clips that they cannot tell
/// themselves. What it leaves out is found as usual.
struct TaughtRoles {
  std::map<Role, TaughtJoint> joints;
  std::optional<double> metres_per_unit = {};
  std::optional<UpAxis> up = {};
  std::optional<double> rate_hz = {};  ///< in the place of the file's own
};

/// Reads a unit: m, cm, mm, in, ft, cmu (5.64 cm), or how many metres one has.
Result<double> ReadUnit(std::string_view text, const Place& place);

/// Reads a joint-map file (docs/clips.md):
///     roles:
///       left_shoulder: LShldr
///       left_elbow: LForeArm
///     unit: cm
///     up: z
///     rate: 120
/// Refused, with line and column: unknown roles, values that are no names, nothing at all.
Result<TaughtRoles> ReadJointMapFile(std::string_view yaml, const std::string& file);

/// Puts a name in double quotes, as YAML reads it back.
std::string QuotedInYaml(std::string_view name);

/// Writes what was found as such a file, with the composed roles and unused joints as comments: a start for one's own.
/// Read back, it gives the same map.
std::string WriteJointMapFile(const Skeleton& skeleton, const JointMap& map);

}  // namespace etude
