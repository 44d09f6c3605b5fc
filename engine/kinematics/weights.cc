#include "engine/kinematics/weights.h"

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

constexpr double kCmPerMetre = 100;
constexpr double kPerSquareCm = kCmPerMetre * kCmPerMetre;  // of a weight per cm², in a weight per m²

template <typename Value>
std::optional<Value> FindIn(const std::vector<std::string>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Value>(found - names.begin());
}

}  // namespace

const std::vector<std::string>& WeightRuleNames() {
  static const std::vector<std::string> names = {"fixed",          "fixed-tuned",    "adaptive",
                                                 "adaptive-tuned", "adaptive-power", "wang-chen"};
  return names;
}

const std::vector<std::string>& WeightRefreshNames() {
  static const std::vector<std::string> names = {"sweep", "joint", "dof"};
  return names;
}

std::optional<WeightRule> FindWeightRule(std::string_view name) { return FindIn<WeightRule>(WeightRuleNames(), name); }

std::optional<WeightRefresh> FindWeightRefresh(std::string_view name) {
  return FindIn<WeightRefresh>(WeightRefreshNames(), name);
}

bool IsAdaptive(WeightRule rule) {
  return rule == WeightRule::kAdaptive || rule == WeightRule::kAdaptiveTuned || rule == WeightRule::kAdaptivePower;
}

EffectorWeights ComputeWeights(WeightRule rule, double distance, const glm::dvec3& axis_angles) {
  const double e = distance * kCmPerMetre;
  switch (rule) {
    case WeightRule::kFixed:
      return {kPerSquareCm, glm::dvec3(1)};
    case WeightRule::kFixedTuned:
      return {0.0015 * kPerSquareCm, glm::dvec3(1)};
    case WeightRule::kAdaptive:
      return {e * kPerSquareCm, axis_angles * Degrees(1)};
    case WeightRule::kAdaptiveTuned:
      return {0.003 * e * kPerSquareCm, axis_angles * Degrees(1)};
    case WeightRule::kAdaptivePower:
      return {5e-5 * std::pow(e, 0.75) * kPerSquareCm,
              {std::pow(axis_angles.x, 0.75), std::pow(axis_angles.y, 0.75), std::pow(axis_angles.z, 0.75)}};
    case WeightRule::kWangChen:
      return {0.0007 * kPerSquareCm, glm::dvec3(1)};
  }
  return {};
}

double WangChenFactor(const glm::dvec3& current, const glm::dvec3& desired) {
  const double c = glm::length(current), d = glm::length(desired);
  const double larger = std::max(c, d);
  return larger > 0 ? 1 + std::min(c, d) / larger : 1;
}

}  // namespace etude
