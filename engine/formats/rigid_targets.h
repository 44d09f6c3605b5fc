#pragma once

#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// Rigid targets on a body, in the order of their files.
enum class BodyTarget {
  kRightForearm,
  kLeftForearm,
  kRightArm,
  kLeftArm,
  kChest,
  kRightThigh,
  kLeftThigh,
  kRightShoulder,
  kLeftShoulder,
  kRightHand,
  kLeftHand,
  kRightFoot,
  kLeftFoot,
  kHips,
  kHead,
  kRightTibia,
  kLeftTibia,
};
constexpr std::size_t kBodyTargetCount = 17;

/// The pose of a target in the optical system's own space, metres.
struct TargetPose {
  glm::dvec3 position{0};
  glm::dquat rotation{1, 0, 0, 0};
};
/// Absent where the cameras did not see the target.
using TargetFrame = std::array<std::optional<TargetPose>, kBodyTargetCount>;

/// Reads optical tracking of 17 rigid targets as text: a line per frame, 17 × (x, y, z, qx, qy, qz, qw). Millimetres;
/// metres when no place is farther than 20 from the origin. A target with nan, or a quaternion of length 0, is
/// missing. Refused, with the line: what `ReadNumberRows` refuses, another count of values, a quaternion whose length
/// is not 1 to within a tenth.
Result<std::vector<TargetFrame>> ReadRigidTargets(std::string_view text, const std::string& file);

}  // namespace etude
