#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"

namespace etude {

constexpr std::size_t kKinectV2JointCount = 25;

/// A place of each role, where there is one.
using RolePlaces = std::array<std::optional<glm::dvec3>, kRoleCount>;

/// One frame of a Kinect v2: where its 25 joints are, in the order of the SDK's JointType, metres, in the sensor's own
/// space (Y up, Z away from it, X to its left: a person who faces it has their left at smaller X).
using KinectV2Frame = std::array<std::optional<glm::dvec3>, kKinectV2JointCount>;

/// Reads a recording of a Kinect v2 as text: a line per frame, 25 × (x, y, z) or, with their orientations, which are
/// left out, 25 × (x, y, z, qx, qy, qz, qw). A joint whose place is nan or (0, 0, 0) is missing. Refused, with the
/// line: what `ReadNumberRows` refuses, another count of values, places farther than 20 m (other units).
Result<std::vector<KinectV2Frame>> ReadKinectV2Text(std::string_view text, const std::string& file);

/// The number of a role's joint in the SDK's JointType.
std::size_t KinectV2JointOf(Role role);

/// The twenty joints of the canonical body, which are Kinect v1's: SpineShoulder is the shoulder centre; Neck, hand
/// tips and thumbs are left out.
RolePlaces PlacesOf(const KinectV2Frame& frame);

}  // namespace etude
