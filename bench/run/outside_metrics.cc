#include "bench/run/outside_metrics.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/results/row_json.h"
#include "bench/run/outside_programs.h"
#include "bench/tasks/base/answer_fields.h"
#include "bench/tasks/base/pose_json.h"
#include "bench/tasks/registry.h"
#include "engine/base/machine.h"

namespace etude {
namespace {

constexpr std::size_t kMaxReasonLength = 200;

Payload SettingOf(const MetricInfo& info, const std::string& task) {
  Json setting{{"metric", info.id}, {"version", info.version}, {"task", task}, {"unit", "m"}};
  setting.update(DescribeBody());
  return PayloadOf(std::move(setting));
}

/// The value that a metric's program returned for a cell.
struct Measured {
  /// kOk: a number, or null with a reason; kUnsolved: the program gave no answer; any other status: a failure.
  Status status = Status::kOk;
  MetricValue value;

  /// Returns true if the metric program itself said that the cell has no value.
  bool IsNull() const { return !value.value && (status == Status::kOk || status == Status::kUnsolved); }
};

/// Returns what a value of this kind must be, if `value` is not; else "".
std::string_view WhatItMustBe(double value, Reading reading) {
  constexpr double kLargest = 1e100;  // sums of squares of larger values would overflow
  if (reading == Reading::kAmount) return std::abs(value) > kLargest ? "-1e100 to 1e100" : "";
  if (reading == Reading::kYesNo && value != 0 && value != 1) return "0 or 1";
  return value >= 0 && value <= 1 ? "" : "0 to 1";
}

Measured ReadValue(const MetricInfo& metric, const OutsideReply& reply) {
  const std::string& id = metric.id;
  const auto missing = [&](Status status, std::string why) {
    return Measured{status, {id, std::nullopt, std::move(why)}};
  };
  // The reason of kUnsolved begins with "gave no answer: ", so it needs no other beginning.
  if (reply.status == Status::kUnsolved) return missing(reply.status, reply.reason);
  if (reply.status != Status::kOk) return missing(reply.status, fmt::format("its program: {}", reply.reason));
  AnswerFields fields(*reply.answer);
  const Json* value = fields.Raw("value");
  std::string why = fields.Has("reason") ? fields.Text("reason", kMaxReasonLength) : "";
  if (value == nullptr || !(value->is_number() || value->is_null())) {
    fields.Note({{}, "value: " + (value == nullptr ? "missing" : ShowJson(*value) + " is neither a number nor null")});
  } else if (value->is_null() && why.empty()) {
    fields.Note({{}, "value: null without a 'reason'"});
  } else if (value->is_number()) {
    const std::string_view allowed = WhatItMustBe(value->get<double>(), metric.reading);
    if (!allowed.empty()) {
      fields.Note(
          {{},
           fmt::format("value: {}; allowed{}: {}", ShowJson(*value),
                       metric.reading == Reading::kAmount ? "" : ", because of the metric's key 'reads'", allowed)});
    }
  }
  if (auto read = fields.Finish(); !read) {
    return missing(Status::kBadOutput, "its program answered " + ToString(read.error()));
  }
  if (value->is_null()) return missing(Status::kOk, std::move(why));
  return {Status::kOk, {id, value->get<double>(), ""}};
}

/// Returns the value of the task's success metric.
std::optional<double> SuccessOf(const CellResult& result, const std::string& task) {
  const auto found = std::ranges::find(result.metrics, FindTaskKind(task)->success, &MetricValue::id);
  return found == result.metrics.end() ? std::nullopt : found->value;
}

std::string Show(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : "null"; }

}  // namespace

std::string ErrorFileOf(const std::string& folder, const Scenario& scenario, const ScenarioProgram& program) {
  return folder.empty() ? ""
                        : fmt::format("{}/{}~{}{}.txt", folder, scenario.name, program.IsMetric() ? "metric~" : "",
                                      program.entry->name);
}

OutsideMetrics::OutsideMetrics(const PreparedScenario& scenario, const std::string& error_folder, const Fence& fence)
    : scenario_(scenario) {
  const Scenario& told = scenario.scenario();
  for (const OutsideMetric& metric : told.outside_metrics) {
    programs_.emplace_back(OptionsOf(scenario, {&metric.program, "metric"}, error_folder, fence));
    settings_.push_back(SettingOf(metric.info, told.task));
  }
}

OutsideReply OutsideMetrics::Ask(std::size_t metric, const std::string& id, const Payload& cell) {
  const std::string& name = scenario_.scenario().name;
  return programs_[metric].Ask(name + "/" + scenario_.scenario().outside_metrics[metric].info.id, settings_[metric], id,
                               cell);
}

std::string OutsideMetrics::Measure(const std::string& cell, CellResult& result) {
  if (programs_.empty() || !result.recording) return "";
  auto json = EncodeMotions(*result.recording);
  if (!json) json = Json::object();  // the same error is reported when the cell's line is encoded
  const Payload told = PayloadOf(*std::move(json));
  // The share of the truth on which a program's metric is judged is the task's success metric, such as `seen_share`.
  const std::optional<double> seen = SuccessOf(result, scenario_.scenario().task);
  for (std::size_t m = 0; m < programs_.size(); ++m) {
    const OutsideReply reply = Ask(m, cell, told);
    if (!reply.was_asked) return reply.reason;
    const MetricInfo& metric = scenario_.scenario().outside_metrics[m].info;
    const std::string& id = metric.id;
    result.metrics.push_back(ReadValue(metric, reply).value);
    if (!result.judged.parts.empty() && seen && *seen < 1) result.judged.shares.emplace_back(id, *seen);
  }
  return "";
}

Result<void> OutsideMetrics::CheckVectors() {
  for (std::size_t m = 0; m < programs_.size(); ++m) {
    const OutsideMetric& metric = scenario_.scenario().outside_metrics[m];
    for (std::size_t v = 0; v < metric.vectors.size(); ++v) {
      const MetricExample& vector = metric.vectors[v];
      ASSIGN_OR_RETURN(auto cell, ReadJson(vector.cell_json, vector.place.file));
      const OutsideReply reply = Ask(m, fmt::format("vector/{}", v), PayloadOf(std::move(cell)));
      if (!reply.was_asked) return tl::unexpected(OfThisMachine({{}, reply.reason}));
      const Measured measured = ReadValue(metric.info, reply);
      const MetricValue& found = measured.value;
      const bool agrees = vector.expected && found.value ? std::abs(*found.value - *vector.expected) <= vector.tolerance
                                                         : !vector.expected && measured.IsNull();
      if (agrees) continue;
      return Fail(vector.place, "metric '{}', test vector {}{}: expected {}, found {}{}", metric.info.id, v + 1,
                  vector.title.empty() ? "" : " (" + vector.title + ")", Show(vector.expected), Show(found.value),
                  found.value ? "" : fmt::format(" ({})", found.null_reason));
    }
  }
  return {};
}

Result<void> CheckMetricVectors(std::span<const PreparedScenario> scenarios, const Fence& fence) {
  for (const PreparedScenario& scenario : scenarios) {
    RETURN_IF_ERROR(OutsideMetrics(scenario, "", fence).CheckVectors());
  }
  return {};
}

}  // namespace etude
