#include "cli/evaluate_parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>

#include "cli/facts.h"

namespace etude {
bool HasAngles(const ScenarioSummary& summary) {
  for (const ConditionSummary& condition : summary.conditions) {
    for (const MethodSummary& method : condition.methods) {
      if (std::ranges::any_of(method.metrics,
                              [](const MetricSummary& one) { return one.id == "angle_rmse_deg" && one.present > 0; })) {
        return true;
      }
    }
  }
  return false;
}

Json FactsOf(const std::vector<AngleAgreement>& angles) {
  const auto figure = [&](const AgreementFigure& one) {
    const auto& interval = one.interval;
    return Json{{"value", OrNull(one.value)},
                {"low", interval ? Json(interval->low) : Json()},
                {"high", interval ? Json(interval->high) : Json()}};
  };
  Json list = Json::array();
  for (const AngleAgreement& one : angles) {
    list.push_back({{"method", one.method},
                    {"condition", ConditionLabel(one.condition)},
                    {"angle", one.angle},
                    {"units", one.agreement.units},
                    {"rmse_deg", figure(one.agreement.rmse)},
                    {"bias_deg", figure(one.agreement.bias)},
                    {"lower_limit_deg", figure(one.agreement.low)},
                    {"upper_limit_deg", figure(one.agreement.high)},
                    {"icc_a1", figure(one.agreement.icc)}});
  }
  return list;
}

Json FactsOf(const std::vector<EvaluatedJoint>& joints) {
  Json list = Json::array();
  for (const EvaluatedJoint& one : joints) {
    list.push_back({{"method", one.method},
                    {"condition", ConditionLabel(one.condition)},
                    {"joint", one.joint},
                    {"pairs", one.pairs[0]},
                    {"unaligned_mm", OrNull(one.mean_mm[0])},
                    {"root_pairs", one.pairs[1]},
                    {"root_mm", OrNull(one.mean_mm[1])},
                    {"each_frame_scaled_pairs", one.pairs[2]},
                    {"each_frame_scaled_mm", OrNull(one.mean_mm[2])}});
  }
  return list;
}

void PrintAngles(const ScenarioSummary& summary, const std::vector<AngleAgreement>& angles) {
  const auto is_of_angles = [](const std::string& id) { return id.starts_with("angle_"); };
  if (angles.empty() || std::ranges::none_of(summary.headline_metrics, is_of_angles)) return;
  fmt::print("  {:<26}  {:>8}  {:>22}  {:>20}  {:>7}  units\n", "angle, degrees", "RMSE", "bias (95 %)",
             "limits of agreement", "ICC");
  const auto shown = [](double value) -> std::string {  // a small value keeps one significant digit
    if (std::abs(value) < 1e-9) return "0.00";
    return std::abs(value) < 0.005 ? fmt::format("{:.1g}", value) : fmt::format("{:.2f}", value);
  };
  const auto range = [&](const std::optional<double>& low, const std::optional<double>& high) {
    return low && high ? shown(*low) + " to " + shown(*high) : std::string("-");
  };
  for (const AngleAgreement& one : angles) {
    const CurveAgreement& figures = one.agreement;
    if (!figures.rmse.value) continue;
    const auto& interval = figures.bias.interval;
    const std::string bias =
        shown(*figures.bias.value) + (interval ? " (" + range(interval->low, interval->high) + ")" : "");
    const std::string under = one.condition.empty() ? "" : ", " + ConditionLabel(one.condition);
    fmt::print("  {:<26}  {:>8}  {:>22}  {:>20}  {:>7}  {:>5}  {}{}\n", one.angle, shown(*figures.rmse.value), bias,
               range(figures.low.value, figures.high.value), figures.icc.value ? shown(*figures.icc.value) : "-",
               figures.units, one.method, under);
  }
}

void PrintJoints(std::vector<EvaluatedJoint> joints) {
  if (joints.empty()) return;
  // List the joints of each method and condition together, the largest error first.
  std::ranges::stable_sort(joints, {}, [](const EvaluatedJoint& one) {
    return std::tuple(ConditionLabel(one.condition), one.method, -one.mean_mm[1].value_or(-1));
  });
  fmt::print("  {:<26}  {:>10}  {:>10}  {:>18}  pairs\n", "mean error of a joint, mm", "unaligned", "by root",
             "each frame scaled");
  const auto shown = [](const std::optional<double>& mean) { return mean ? fmt::format("{:.1f}", *mean) : "-"; };
  for (const EvaluatedJoint& one : joints) {
    const std::string under = one.condition.empty() ? "" : ", " + ConditionLabel(one.condition);
    // Print one number of pairs if all columns have the same.
    std::vector<int> counts(one.pairs.begin(), one.pairs.end());
    if (std::ranges::count(counts, counts.front()) == std::ssize(counts)) counts.resize(1);
    fmt::print("  {:<26}  {:>10}  {:>10}  {:>18}  {:>5}  {}{}\n", one.joint, shown(one.mean_mm[0]),
               shown(one.mean_mm[1]), shown(one.mean_mm[2]), fmt::join(counts, "/"), one.method, under);
  }
}

}  // namespace etude
