#include "tests/bench/metrics/vector_input.h"

#include <nlohmann/json.hpp>
#include <string>

namespace etude {
namespace {

constexpr int kMaxFrames = 100'000;

/// Maps each joint's name to its index, as JSON; an unknown name throws Json::exception.
const Json& RoleIndices() {
  static const Json indices = [] {
    Json all = Json::object();
    for (Role role : AllRoles()) all[std::string(RoleName(role))] = Index(role);
    return all;
  }();
  return indices;
}

}  // namespace

glm::dvec3 ReadPoint(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

std::optional<glm::dvec3> ReadOptionalPoint(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return ReadPoint(json);
}

glm::dmat3 ReadAxes(const Json& json) { return {ReadPoint(json.at(0)), ReadPoint(json.at(1)), ReadPoint(json.at(2))}; }

BodyPose ReadPose(const Json& json) {
  BodyPose pose;
  for (const auto& [name, position] : json.items()) {
    pose.joints[RoleIndices().at(name).get<std::size_t>()] = ReadPoint(position);
  }
  return pose;
}

BodyMotion ReadMotion(const Json& json) {
  BodyMotion motion{json.value("rate_hz", kJudgedRateHz), {}};
  motion.poses.resize(std::min(json.at("frames").get<std::size_t>(), std::size_t{kMaxFrames}));
  for (const auto& [name, positions] : json.at("joints_m").items()) {
    const std::size_t joint = RoleIndices().at(name).get<std::size_t>();
    for (std::size_t f = 0; f < motion.poses.size(); ++f) {
      motion.poses[f].joints[joint] = ReadPoint(positions.at(positions.size() == 1 ? 0 : f));
    }
  }
  return motion;
}

Mask ReadMask(const Json& json) {
  Mask mask(static_cast<int>(json.at(0).size()), static_cast<int>(json.size()));
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      mask.At(x, y) = json.at(static_cast<std::size_t>(y)).at(static_cast<std::size_t>(x)).get<std::uint8_t>();
    }
  }
  return mask;
}

}  // namespace etude
