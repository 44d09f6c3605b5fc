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

/// Rigid targets on a body, in the order of the files.
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

/// The pose of a target in the optical system's frame, in metres.
struct TargetPose {
  glm::dvec3 position{0};
  glm::dquat rotation{1, 0, 0, 0};
};
/// One frame; a target that the cameras did not see is empty.
using TargetFrame = std::array<std::optional<TargetPose>, kBodyTargetCount>;

/// Reads optical tracking of 17 rigid targets as text with one line per frame: 17 × (x, y, z, qx, qy, qz, qw). The unit
/// is millimetres, or metres if no coordinate exceeds 20. A target with nan or a quaternion of length 0 is missing.
/// Returns an error with the line for anything that `ReadNumberRows` refuses, another number of values, or a quaternion
/// whose length differs from 1 by more than 0.1.
Result<std::vector<TargetFrame>> ReadRigidTargets(std::string_view text, const std::string& file);

}  // namespace etude
