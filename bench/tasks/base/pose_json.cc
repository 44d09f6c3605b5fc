#include "bench/tasks/base/pose_json.h"

#include <nlohmann/json.hpp>

#include "bench/tasks/base/answer_fields.h"

namespace etude {

Json EncodePoses(std::span<const BodyPose> poses) {
  Json list = Json::array();
  for (const BodyPose& pose : poses) list.push_back(EncodePose(pose));
  return list;
}

Json DescribeBody() {
  Json joints = Json::array(), parents = Json::array();
  for (const Role role : AllRoles()) {
    const std::optional<Role> parent = ParentOf(role);
    joints.push_back(RoleName(role));
    parents.push_back(parent ? Json(RoleName(*parent)) : Json(nullptr));
  }
  return {{"joints", std::move(joints)}, {"parents", std::move(parents)}};
}

Result<BodyPose> ReadPose(const Json& json, const std::string& path) {
  constexpr double kMaxCoordinate = 1000;
  ASSIGN_OR_RETURN(const auto numbers, ReadNumbers(json, path, 3 * kRoleCount, {-kMaxCoordinate, kMaxCoordinate}));
  BodyPose pose;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    pose.joints[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
  }
  return pose;
}

}  // namespace etude
