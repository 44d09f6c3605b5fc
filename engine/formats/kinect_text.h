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

/// The position of each role's joint, metres; nullopt if the joint is missing.
using RolePositions = std::array<std::optional<glm::dvec3>, kRoleCount>;

/// One frame of a Kinect v2: the positions of its 25 joints in the order of the SDK's JointType, metres. Axes are the
/// sensor's: Y up, Z away from the sensor, X to the sensor's left. The left side of a person who faces the sensor has
/// smaller X.
using KinectV2Frame = std::array<std::optional<glm::dvec3>, kKinectV2JointCount>;

/// Reads a recording of a Kinect v2 as text with one line per frame: 25 × (x, y, z), or 25 × (x, y, z, qx, qy, qz, qw),
/// whose orientations are ignored. A heading may name the joints (FindKinectJoints). A joint at nan, (0, 0, 0) or (-1,
/// -1, -1) is missing. Returns an error if `ReadNumberRows` refuses the text, or if the lines do not have 75 or 175
/// values. Positions in another unit than metres are an error as well. Signs of another unit are a position farther
/// than 20 m from the sensor, and positions that are all nearer than 5 cm.
Result<std::vector<KinectV2Frame>> ReadKinectV2Text(std::string_view text, const std::string& file);

/// Returns the index of a role's joint in the SDK's JointType.
std::size_t KinectV2JointOf(Role role);

/// Returns the positions of the canonical body's twenty joints, which are the joints of Kinect v1. SpineShoulder
/// becomes the shoulder centre; Neck, hand tips and thumbs are left out.
RolePositions PlacesOf(const KinectV2Frame& frame);

}  // namespace etude
