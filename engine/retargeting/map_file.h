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
struct JointOverride {
  std::string name;  ///< the joint's name in the clip; "LeftHand_End" for BVH's End Sites
  Place place;       ///< position in the file, for error messages
};

/// The content of a joint-map file: the joints that play roles, and properties that clip files lack. FindJointMap finds
/// the roles that the file leaves out.
struct JointMapOverrides {
  std::map<Role, JointOverride> joints;
  std::optional<double> metres_per_unit = {};
  std::optional<UpAxis> up = {};
  std::optional<double> rate_hz = {};  ///< replaces the file's own rate
  bool keep_floor = false;             ///< true: the file's floor is not moved to 0
  std::string marker_set = "";         ///< the key (MarkerSetKeys) of the set to use for a marker file; "": by rank
};

/// Reads a unit and returns its length in metres. `text` is m, cm, mm, in, ft, cmu (5.64 cm) or the length itself.
Result<double> ReadUnit(std::string_view text, const Place& place);

/// Reads a joint-map file (docs/clips.md):
///     roles:
///       left_shoulder: LShldr
///       left_elbow: LForeArm
///     unit: cm
///     up: z
///     rate: 120
///     keep_floor: true
///     marker_set: opencap
/// Fails, with line and column, for unknown roles, values that are not names, and an empty file.
Result<JointMapOverrides> ReadJointMapFile(std::string_view yaml, const std::string& file);

/// Returns a name in double quotes, escaped so that YAML reads it back unchanged.
std::string QuotedInYaml(std::string_view name);

/// Writes the map as a joint-map file, with the composed roles and unused joints as comments. Users can edit it.
/// Reading the file returns an equal map.
std::string WriteJointMapFile(const Skeleton& skeleton, const JointMap& map);

}  // namespace etude
