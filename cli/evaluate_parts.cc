#include "cli/evaluate_parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "bench/run/shipped.h"
#include "bench/tasks/plausibility/judge.h"
#include "bench/tasks/plausibility/options.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/named_results.h"
#include "engine/base/names.h"
#include "engine/document/node.h"
#include "engine/retargeting/map_file.h"
#include "io/drawing/numbers.h"
#include "io/files/files.h"

namespace etude {
namespace {

}  // namespace

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

namespace {

namespace fs = std::filesystem;

/// Reads limits from the file `name`, or from the shipped file of that name ("recorded").
Result<std::map<std::string, double>> ReadLimitsFile(const std::string& name) {
  std::error_code none;
  const fs::path folder = ShippedFolder() / "scenarios" / "limits", shipped = folder / (name + ".yaml");
  fs::path file = name;
  if (!fs::exists(name, none)) {
    std::vector<std::string> known;
    for (const auto& entry : fs::directory_iterator(folder, none)) known.push_back(entry.path().stem().string());
    std::ranges::sort(known);
    if (std::ranges::find(known, name) == known.end()) {
      return Fail({"--limits"}, "there is no such file of limits; {}, or the path of a file",
                  UnknownName("name of limits", name, known));
    }
    file = shipped;
  }
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(file));
  ASSIGN_OR_RETURN(const auto node, ParseYaml(text, file.string()));
  Fields fields(node, "a file of limits");
  auto limits = ReadLimits(fields);
  RETURN_IF_ERROR(fields.Finish());
  if (limits.empty())
    return Fail({file.string()},
                "contains no limit; allowed: one metric and its limit per line, such as skates_share: 0.02");
  return limits;
}

/// For each kind of fault: a metric that is above 0 if a clip shows the fault, and the word for the fault.
constexpr std::pair<std::string_view, std::string_view> kTelling[] = {
    {"floats_share", "floats"}, {"sinks_share", "sinks"},   {"skates_share", "skates"},
    {"jumps", "jumps"},         {"pops", "pops"},           {"freezes_share", "freezes"},
    {"bends_share", "bends"},   {"passes_share", "passes"}, {"stretches_max_percent", "stretches"},
    {"torn_max_cm", "torn"},    {"gaps_share", "gaps"},     {"wrong_rate", "wrong rate"}};

/// Prints the number of lines and the heading ("2 not judged:"), then at most twenty lines.
void PrintLines(std::string_view heading, const std::vector<std::string>& lines) {
  fmt::print("{} {}{}\n", lines.size(), heading, lines.empty() ? "" : ":");
  for (const std::string& line : FirstLines(lines, 20, "more; `etude rows` prints all cells"))
    fmt::print("  {}\n", line);
}

}  // namespace

Result<std::string> ScenarioOfMotions(const std::vector<std::string>& files, const AloneOptions& options,
                                      const std::string& people) {
  ASSIGN_OR_RETURN(const auto methods, ReadMotions(files));
  std::string text = "scenario: evaluate\nquestion: Could a person have made these motions?\ntask: plausibility\n";
  if (options.floor_m) text += fmt::format("floor_m: {}\n", *options.floor_m);
  if (!people.empty()) text += fmt::format("people: {}\n", QuotedInYaml(people));
  if (!options.limits.empty()) {
    ASSIGN_OR_RETURN(const auto limits, ReadLimitsFile(options.limits));
    text += "at_most:\n";
    for (const auto& [id, limit] : limits) text += fmt::format("  {}: {}\n", id, limit);
  }
  return text + MethodsInYaml(methods);
}

Triage TriageOf(const RunData& run) {
  Triage triage;
  ForEachRow(run, [&](const Row& row, std::size_t) {
    const std::string name = fmt::format("{}, {}: ", row.method, row.clip);
    if (row.result.status != Status::kOk) {
      if (row.result.status != Status::kSkipped) triage.not_judged.push_back(name + row.result.reason);
      return;
    }
    ++triage.clips;
    const std::string line = name + std::string(FaultWords(row.result.reason));
    for (const auto& [id, word] : kTelling) {
      if (ValueOf(row, id).value_or(0) > 0) ++triage.kinds[std::string(word)];
    }
    const auto is_within = ValueOf(row, "within_limits");
    triage.has_limits |= is_within.has_value();
    const bool is_faulty = ValueOf(row, "faults").value_or(0) > 0;
    triage.fault_free += is_faulty ? 0 : 1;
    if (is_within == 0.0) {
      triage.beyond_limits.push_back(line);
    } else if (is_faulty) {
      triage.faulty.push_back(line);
    }
  });
  return triage;
}

void PrintTriage(const Triage& triage) {
  fmt::print("{} of {} without a fault{}\n", triage.fault_free, Plural(static_cast<long long>(triage.clips), "clip"),
             triage.not_judged.empty() ? "" : fmt::format(", {} more could not be judged", triage.not_judged.size()));
  for (const auto& [kind, clips] : triage.kinds) fmt::print("  {:<10}  {:>6}\n", kind, clips);
  if (!triage.kinds.empty()) fmt::print("  `etude list faults` explains each fault\n");
  if (triage.has_limits) PrintLines("beyond the limits", triage.beyond_limits);
  if (!triage.faulty.empty())
    PrintLines(triage.has_limits ? "with faults that are within the limits" : "with faults", triage.faulty);
  if (!triage.not_judged.empty()) PrintLines("not judged", triage.not_judged);
}

}  // namespace etude
