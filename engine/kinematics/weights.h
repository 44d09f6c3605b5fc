#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// How much an end effector's position counts against its three axes. Paper B, section 3.7.3, asks for weights that
/// follow the errors and gives no formula; the formulas are ours. e = distance to the target in cm,
/// θ_k = angle of axis k to its target.
enum class WeightRule {
  kFixed,          ///< w_p = 1, w_o = 1
  kFixedTuned,     ///< w_p = 0.0015, w_o = 1
  kAdaptive,       ///< w_p = e, w_ok = θ_k in degrees: B's rule, plain
  kAdaptiveTuned,  ///< w_p = 0.003 e, w_ok = θ_k in degrees
  kAdaptivePower,  ///< w_p = 5·10⁻⁵ e^0.75, w_ok = θ_k^0.75, radians
  kWangChen,       ///< w_p = 0.0007 (1 + min/max(|P_d|, |P_c|)), w_o = 1 (Wang and Chen 1991)
};

/// When errors are measured anew for the weights that depend on them.
enum class WeightRefresh { kSweep, kJoint, kDof };

/// The names of scenario files: "fixed", "fixed-tuned", … and "sweep", "joint", "dof".
const std::vector<std::string>& WeightRuleNames();
const std::vector<std::string>& WeightRefreshNames();
std::optional<WeightRule> FindWeightRule(std::string_view name);
std::optional<WeightRefresh> FindWeightRefresh(std::string_view name);

/// The weights of one end effector.
struct EffectorWeights {
  double position = 1;  ///< w_p per square METRE (the formulas' value, which is per cm², times 10⁴)
  glm::dvec3 axes{1};   ///< w_o1, w_o2, w_o3
};

/// Which power of an error a weight grows with.
enum class ErrorPower { kNone, kThreeQuarters, kOne };

/// A rule as numbers: w_p = `position` · e^power, w_ok = `axis` · θ_k^power with e in metres and θ_k in radians.
struct WeightFormula {
  double position = 1;
  double axis = 1;
  ErrorPower power = ErrorPower::kNone;
};

/// Of `kWangChen` the part without ρ.
WeightFormula FormulaOf(WeightRule rule);

/// Whether the rule depends on errors. `kWangChen` does not: it depends on the joint that turns.
bool IsAdaptive(WeightRule rule);

/// The weights by `rule` for an effector `distance` metres from its target with axes off by `axis_angles` radians.
/// For `kWangChen` this is the part without ρ; multiply `position` by `WangChenFactor` at each joint.
EffectorWeights ComputeWeights(WeightRule rule, double distance, const glm::dvec3& axis_angles);

/// 1 + ρ, where ρ = min / max of the distances of the effector and of its target from the joint; 1 when both are 0.
double WangChenFactor(const glm::dvec3& current, const glm::dvec3& desired);

}  // namespace etude
