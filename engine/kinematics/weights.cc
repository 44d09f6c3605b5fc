#include "engine/kinematics/weights.h"

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/named.h"

namespace etude {
namespace {

constexpr double kCmPerMetre = 100;
constexpr double kPerSquareCm = kCmPerMetre * kCmPerMetre;  // of a weight per cm², in a weight per m²

constexpr Named<WeightRule> kRules[] = {{"fixed", WeightRule::kFixed},
                                        {"fixed-tuned", WeightRule::kFixedTuned},
                                        {"adaptive", WeightRule::kAdaptive},
                                        {"adaptive-tuned", WeightRule::kAdaptiveTuned},
                                        {"adaptive-power", WeightRule::kAdaptivePower},
                                        {"wang-chen", WeightRule::kWangChen}};
constexpr Named<WeightRefresh> kRefreshes[] = {
    {"sweep", WeightRefresh::kSweep}, {"joint", WeightRefresh::kJoint}, {"dof", WeightRefresh::kDof}};

}  // namespace

const std::vector<std::string>& WeightRuleNames() {
  static const std::vector<std::string> names = NamesOf(kRules);
  return names;
}

const std::vector<std::string>& WeightRefreshNames() {
  static const std::vector<std::string> names = NamesOf(kRefreshes);
  return names;
}

std::optional<WeightRule> FindWeightRule(std::string_view name) { return FindValue(kRules, name); }

std::optional<WeightRefresh> FindWeightRefresh(std::string_view name) { return FindValue(kRefreshes, name); }

WeightFormula FormulaOf(WeightRule rule) {
  constexpr double kRoot = 31.622776601683793;  // 100^0.75, of centimetres in a metre
  switch (rule) {
    case WeightRule::kFixed:
      return {kPerSquareCm, 1, ErrorPower::kNone};
    case WeightRule::kFixedTuned:
      return {0.0015 * kPerSquareCm, 1, ErrorPower::kNone};
    case WeightRule::kAdaptive:
      return {kCmPerMetre * kPerSquareCm, Degrees(1), ErrorPower::kOne};
    case WeightRule::kAdaptiveTuned:
      return {0.003 * kCmPerMetre * kPerSquareCm, Degrees(1), ErrorPower::kOne};
    case WeightRule::kAdaptivePower:
      return {5e-5 * kRoot * kPerSquareCm, 1, ErrorPower::kThreeQuarters};
    case WeightRule::kWangChen:
      return {0.0007 * kPerSquareCm, 1, ErrorPower::kNone};
  }
  return {};
}

bool IsAdaptive(WeightRule rule) { return FormulaOf(rule).power != ErrorPower::kNone; }

EffectorWeights ComputeWeights(WeightRule rule, double distance, const glm::dvec3& axis_angles) {
  const WeightFormula formula = FormulaOf(rule);
  const auto power = [&formula](double error) {
    switch (formula.power) {
      case ErrorPower::kNone:
        return 1.0;
      case ErrorPower::kThreeQuarters:
        return std::sqrt(error * std::sqrt(error));  // the same bits with every libm, unlike std::pow
      case ErrorPower::kOne:
        return error;
    }
    return 1.0;
  };
  return {formula.position * power(distance),
          formula.axis * glm::dvec3(power(axis_angles.x), power(axis_angles.y), power(axis_angles.z))};
}

double WangChenFactor(const glm::dvec3& current, const glm::dvec3& desired) {
  const double c = glm::length(current), d = glm::length(desired);
  const double larger = std::max(c, d);
  return larger > 0 ? 1 + std::min(c, d) / larger : 1;
}

}  // namespace etude
