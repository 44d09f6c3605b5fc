#include "engine/formats/kinect_text.h"

#include <algorithm>
#include <cmath>

#include "engine/formats/kinect_columns.h"
#include "engine/formats/number_rows.h"

namespace etude {
namespace {

/// The index of each role's joint in the SDK's JointType, in the order of the roles.
constexpr std::array<std::size_t, kRoleCount> kJointOfRole = {0,  1,  20, 3,                   // trunk and head
                                                              4,  5,  6,  7,  8,  9,  10, 11,  // arms
                                                              12, 13, 14, 15, 16, 17, 18, 19};
constexpr std::size_t kPlaceColumns = 3 * kKinectV2JointCount;
constexpr std::size_t kPoseColumns = 7 * kKinectV2JointCount;
constexpr double kMinDistance = 0.05, kMaxDistance = 20;  // metres; a Kinect's range is 0.5 to 4.5

}  // namespace

Result<std::vector<KinectV2Frame>> ReadKinectV2Text(std::string_view text, const std::string& file) {
  ASSIGN_OR_RETURN(const NumberRows table, ReadNumberRows(text, file));
  if (table.columns != kPlaceColumns && table.columns != kPoseColumns) {
    return Fail({file},
                "found {} values in this row; allowed for a Kinect v2 recording: {} (x y z per joint) or {} (x y z and "
                "a quaternion per joint)",
                table.columns, kPlaceColumns, kPoseColumns);
  }
  const std::size_t stride = table.columns / kKinectV2JointCount;
  ASSIGN_OR_RETURN(const auto named, FindKinectJoints(table, {kKinectV2JointCount, 0, stride}, file));
  std::vector<KinectV2Frame> frames(table.RowCount());
  double farthest = 0;
  for (std::size_t t = 0; t < frames.size(); ++t) {
    const auto row = table.Row(t);
    for (std::size_t j = 0; j < kKinectV2JointCount; ++j) {
      const std::size_t at = stride * (named.empty() ? j : named[j]);
      const glm::dvec3 place(row[at], row[at + 1], row[at + 2]);
      if (std::isnan(place.x + place.y + place.z) || place == glm::dvec3(0) || place == glm::dvec3(-1)) continue;
      farthest = std::max(farthest, glm::length(place));
      if (glm::length(place) > kMaxDistance) {
        return Fail({file, table.lines[t]},
                    "joint {} is {:.1f} m from the sensor; allowed: at most {} m; positions must be in metres", j,
                    glm::length(place), kMaxDistance);
      }
      frames[t][j] = place;
    }
  }
  if (farthest > 0 && farthest < kMinDistance) {
    return Fail({file},
                "all joints are within {:.3g} m of the sensor, so the positions are probably not in metres; allowed: "
                "positions in metres",
                farthest);
  }
  return frames;
}

std::size_t KinectV2JointOf(Role role) { return kJointOfRole[Index(role)]; }

RolePositions PlacesOf(const KinectV2Frame& frame) {
  RolePositions places;
  for (std::size_t i = 0; i < kRoleCount; ++i) places[i] = frame[kJointOfRole[i]];
  return places;
}

}  // namespace etude
