#include "reports/charts.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/files/json.h"
#include "reports/words/cell_series.h"
#include "reports/words/figures.h"
#include "reports/words/findings.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

// More steps than a screen has room for only make the page heavy.
constexpr std::size_t kMostSteps = 120;
// Beyond this ratio a linear axis squeezes all but the largest values into one line.
constexpr double kLogarithmicFrom = 100;

std::string Caption(const std::string& what, const MetricWords& words) {
  const std::string unit = UnitOf(words);
  std::string caption = what + " of the " + words.plain_label;
  if (!unit.empty()) caption += fmt::format(" ({})", unit);
  if (const auto direction = DirectionWords(words.direction); !direction.empty())
    caption += fmt::format("; {}", direction);
  return caption;
}

bool NeedsLogarithm(const std::vector<double>& values) {
  if (values.empty() || std::ranges::any_of(values, [](double v) { return v <= 0; })) return false;
  const auto [low, high] = std::ranges::minmax(values);
  return high / low > kLogarithmicFrom;
}

// "orientation_error_deg" over all effectors is "orientation_error_max_deg" of the worst.
std::string WorstOf(const std::string& metric) {
  const std::size_t unit = metric.rfind('_');
  return unit == std::string::npos ? metric : metric.substr(0, unit) + "_max" + metric.substr(unit);
}

// The scenario's first metric that cells have along the axis, or have of the worst effector; else the first of any.
// Curves that are no metric, such as one effector's, have pictures of their own; zeros are errors of what was not asked
// for; a median of yes and no says nothing.
std::optional<std::string> FindCurve(const RunData& run, const ScenarioSummary& scenario, const std::string& axis,
                                     const std::map<std::string, std::string>& method_of) {
  std::vector<std::string> found;
  for (const CellSeries& cell : run.series) {
    if (!method_of.contains(cell.cell)) continue;
    for (const Series& series : cell.series) {
      if (series.axis != axis || FindMetric(series.name) == nullptr || WordsFor(series.name).is_share) continue;
      if (std::ranges::any_of(series.values, [](double value) { return value > 0; })) found.push_back(series.name);
    }
  }
  const auto is_found = [&](const std::string& metric) { return std::ranges::find(found, metric) != found.end(); };
  for (const std::string& headline : scenario.headline_metrics) {
    for (const std::string& name : {headline, WorstOf(headline)}) {
      if (is_found(name)) return name;
    }
  }
  return found.empty() ? std::nullopt : std::optional(found.front());
}

std::vector<double> Thinned(const std::vector<double>& curve, std::size_t stride) {
  std::vector<double> out;
  for (std::size_t i = 0; i < curve.size(); i += stride) out.push_back(curve[i]);
  return out;
}

}  // namespace

std::optional<Chart> CurveChart(const RunData& run, const ScenarioSummary& scenario) {
  if (scenario.conditions.empty()) return std::nullopt;
  const bool follows_motion = scenario.task == "tracking";
  const std::vector<SweptValue>& first = scenario.conditions.front().condition;
  std::map<std::string, std::string> method_of;
  for (const Row& row : run.rows) {
    if (row.scenario == scenario.name && (!follows_motion || row.condition == first)) method_of[row.Id()] = row.method;
  }
  const std::string axis = follows_motion ? "frame" : "iteration";
  const auto name = FindCurve(run, scenario, axis, method_of);
  if (!name) return std::nullopt;

  std::map<std::string, std::vector<const std::vector<double>*>> curves;
  for (const CellSeries& cell : run.series) {
    const auto method = method_of.find(cell.cell);
    if (method == method_of.end()) continue;
    for (const Series& series : cell.series) {
      if (series.name == *name && !series.values.empty()) curves[method->second].push_back(&series.values);
    }
  }

  std::map<std::string, std::vector<double>> medians;
  std::size_t longest = 0;
  for (const auto& [method, of_method] : curves) {
    medians[method] = MedianCurve(of_method);
    longest = std::max(longest, medians[method].size());
  }
  const std::size_t stride = std::max<std::size_t>(1, (longest + kMostSteps - 1) / kMostSteps);

  const MetricWords words = WordsFor(*name);
  Chart chart;
  chart.is_wide = follows_motion;
  chart.caption = Caption(follows_motion ? "Frame by frame: median" : "How fast it gets there: median", words);
  if (scenario.conditions.size() > 1) {
    chart.caption += follows_motion ? fmt::format("; under {}", ConditionLabel(first)) : "; over all conditions";
  }
  Json methods = Json::array();
  std::vector<double> drawn;
  for (const std::string& method : scenario.methods) {
    const auto found = medians.find(method);
    if (found == medians.end()) continue;
    const std::vector<double>& curve = found->second;
    drawn.insert(drawn.end(), curve.begin(), curve.end());
    chart.description +=
        fmt::format("{}: from {} to {} in {}. ", method, FormatNumber(curve.front()) + words.suffix,
                    FormatNumber(curve.back()) + words.suffix, Plural(static_cast<long long>(curve.size()) - 1, axis));
    Json values = Json::array();
    for (const double value : Thinned(curve, stride)) values.push_back(value);
    methods.push_back({{"name", MethodLabel(scenario, method)}, {"values", std::move(values)}});
  }
  Json json{{"kind", "curves"},
            {"label", words.label},
            {"suffix", words.suffix},
            {"axis", axis},
            {"stride", stride},
            {"methods", std::move(methods)},
            {"logarithmic", NeedsLogarithm(drawn)}};
  chart.json = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return chart;
}

}  // namespace etude
