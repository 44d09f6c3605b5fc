#include "bench/tasks/ik/exchange.h"

#include <nlohmann/json.hpp>

#include "bench/tasks/base/answer_fields.h"
#include "engine/base/angles.h"

namespace etude {
namespace {

constexpr std::array kAxisNames = {"x", "y", "z"};

Json ToJson(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// By rows.
Json ToJson(const glm::dmat3& rotation) {
  const glm::dmat3 rows = glm::transpose(rotation);
  return {ToJson(rows[0]), ToJson(rows[1]), ToJson(rows[2])};
}

Json InDegrees(std::span<const double> angles) {
  Json list = Json::array();
  for (const double angle : angles) list.push_back(Degrees(angle));
  return list;
}

std::optional<int> ReadCount(AnswerFields& fields, const char* key) {
  constexpr int kMost = 1'000'000'000;
  if (!fields.Has(key)) return std::nullopt;
  return fields.Integer(key, 0, kMost);
}

}  // namespace

Json DescribeTree(const KinematicTree& tree, int max_steps, double position_goal, double axis_goal) {
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
                      {"offset_m", ToJson(joint.offset)},
                      {"rest", ToJson(joint.rest)},
                      {"first_angle", joint.first_dof},
                      {"axes", std::move(axes)}});
  }
  for (const Effector& effector : tree.effectors) {
    effectors.push_back({{"name", effector.name}, {"joint", effector.joint}, {"offset_m", ToJson(effector.offset)}});
  }
  return {{"joints", std::move(joints)},
          {"angles", std::move(angles)},
          {"effectors", std::move(effectors)},
          {"max_steps", max_steps},
          {"position_goal_cm", 100 * position_goal},
          {"orientation_goal_deg", Degrees(axis_goal)}};
}

Json DescribeProblem(const KinematicTree& tree, const IkProblem& problem) {
  Json targets = Json::array();
  for (std::size_t e = 0; e < problem.targets.size(); ++e) {
    targets.push_back({{"effector", tree.effectors[e].name},
                       {"position_m", ToJson(problem.targets[e].position)},
                       {"rotation", ToJson(problem.targets[e].axes)}});
  }
  return {
      {"root", {{"position_m", ToJson(problem.start.root_position)}, {"rotation", ToJson(problem.start.root_frame)}}},
      {"start_angles_deg", InDegrees(problem.start.angles)},
      {"targets", std::move(targets)}};
}

Json DescribeTruth(const IkWorld& world) { return {{"angles_deg", InDegrees(world.truth.angles)}}; }

Result<IkAnswer> ReadIkAnswer(const Json& json, const KinematicTree& tree) {
  constexpr double kLargest = 1e6;  // degrees
  AnswerFields fields(json);
  IkAnswer answer;
  const Json& degrees = fields.List("angles_deg", tree.limits.size(), tree.limits.size());
  answer.iterations = ReadCount(fields, "iterations");
  answer.fk_evaluations = ReadCount(fields, "fk_evaluations");
  if (auto done = fields.Finish(); !done) return tl::unexpected(done.error());
  const auto numbers = ReadNumbers(degrees, "angles_deg", tree.limits.size(), {-kLargest, kLargest});
  if (!numbers) return tl::unexpected(numbers.error());
  for (const double angle : *numbers) answer.angles.push_back(Radians(angle));
  return answer;
}

}  // namespace etude
