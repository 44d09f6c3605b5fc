#include "bench/tasks/base/tree_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "bench/tasks/base/answer_fields.h"
#include "engine/base/angles.h"

namespace etude {
namespace {

constexpr std::array kAxisNames = {"x", "y", "z"};

Json ToJson(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// Encodes a rotation as the list of its three rows.
Json ToJson(const glm::dmat3& rotation) {
  const glm::dmat3 rows = glm::transpose(rotation);
  return {ToJson(rows[0]), ToJson(rows[1]), ToJson(rows[2])};
}

}  // namespace

Json DescribeBodyTree(const KinematicTree& tree) {
  Json joints = Json::array(), angles = Json::array(), effectors = Json::array();
  for (const TreeJoint& joint : tree.joints) {
    Json axes = Json::array();
    for (int axis = 0; axis < joint.dof_count; ++axis) {
      const AngleRange& limits = tree.limits[static_cast<std::size_t>(joint.first_dof + axis)];
      axes.push_back(kAxisNames[axis]);
      angles.push_back({{"name", fmt::format("{}.{}", joint.name, kAxisNames[axis])},
                        {"lower_deg", Degrees(limits.lower)},
                        {"upper_deg", Degrees(limits.upper)}});
    }
    joints.push_back({{"name", joint.name},
                      {"parent", joint.parent < 0 ? Json(nullptr) : Json(joint.parent)},
                      {"offset_m", ToJson(joint.p_PJ)},
                      {"rest", ToJson(joint.R_PJ)},
                      {"first_angle", joint.first_dof},
                      {"axes", std::move(axes)}});
  }
  for (const Effector& effector : tree.effectors) {
    effectors.push_back({{"name", effector.name}, {"joint", effector.joint}, {"offset_m", ToJson(effector.p_LE)}});
  }
  return {{"joints", std::move(joints)}, {"angles", std::move(angles)}, {"effectors", std::move(effectors)}};
}

Json DescribeGoals(const IkOptions& options) {
  return {{"max_steps", options.max_iterations},
          {"position_goal_cm", 100 * options.position_goal},
          {"orientation_goal_deg", Degrees(options.axis_goal)}};
}

Json DescribeRoot(const TreeState& state) {
  return {{"position_m", ToJson(state.root_position)}, {"rotation", ToJson(state.root_frame)}};
}

Json DescribeTargets(const KinematicTree& tree, std::span<const EffectorTarget> targets) {
  Json list = Json::array();
  for (std::size_t e = 0; e < targets.size(); ++e) {
    list.push_back({{"effector", tree.effectors[e].name},
                    {"position_m", ToJson(targets[e].position)},
                    {"rotation", ToJson(targets[e].axes)}});
  }
  return list;
}

Json InDegrees(std::span<const double> angles) {
  Json list = Json::array();
  for (const double angle : angles) list.push_back(Degrees(angle));
  return list;
}

Result<std::vector<double>> ReadDegrees(const Json& json, const std::string& path, std::size_t count) {
  constexpr double kMaxDegrees = 1e6;
  auto angles = ReadNumbers(json, path, count, {-kMaxDegrees, kMaxDegrees});
  if (!angles) return tl::unexpected(angles.error());
  for (double& angle : *angles) angle = Radians(angle);
  return angles;
}

std::string DescribeBrokenLimits(const KinematicTree& tree, std::span<const double> angles, std::string_view path) {
  constexpr double kRounding = Radians(1e-6);
  int broken = 0;
  double worst = 0;
  std::size_t worst_angle = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double beyond = std::max(tree.limits[i].lower - angles[i], angles[i] - tree.limits[i].upper);
    if (beyond <= kRounding) continue;
    ++broken;
    if (beyond > worst) {
      worst = beyond;
      worst_angle = i;
    }
  }
  if (broken == 0) return "";
  return fmt::format("{} angle{} outside the limits; {}[{}] is the farthest outside, by {:.2g}°", broken,
                     broken == 1 ? "" : "s", path, worst_angle, Degrees(worst));
}

}  // namespace etude
