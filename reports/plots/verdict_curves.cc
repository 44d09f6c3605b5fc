#include "reports/plots/verdict_curves.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "reports/plots/marks.h"
#include "reports/plots/panel.h"
#include "reports/words/escape.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

constexpr double kRocHeight = 240, kRocTop = 8, kRocBottom = 208;
constexpr std::size_t kMostConditions = 4;
constexpr std::size_t kMostRocs = 16;

using SharePoints = std::vector<std::pair<double, double>>;

const Series* FindSeries(const CellSeries& cell, std::string_view name) {
  const auto found = std::ranges::find(cell.series, name, &Series::name);
  return found == cell.series.end() ? nullptr : &*found;
}

void AddPerformances(const CellSeries& cell, int person, std::vector<JudgedPerformance>& all) {
  const Series *score = FindSeries(cell, "performance_score"), *truth = FindSeries(cell, "performance_truth"),
               *called = FindSeries(cell, "performance_called"), *severity = FindSeries(cell, "performance_severity");
  if (score == nullptr || truth == nullptr || called == nullptr || severity == nullptr) return;
  const std::size_t count = score->values.size();
  if (truth->values.size() != count || called->values.size() != count || severity->values.size() != count) return;
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back({person, score->values[i], truth->values[i], called->values[i] > 0, severity->values[i]});
  }
}

/// By method, in the scenario's order, of those that judged something.
std::map<std::size_t, std::vector<JudgedPerformance>> PerformancesUnder(const RunData& run,
                                                                        const ScenarioSummary& scenario,
                                                                        const ConditionSummary& condition) {
  std::map<std::string, const Row*> rows;
  for (const Row& row : run.rows) {
    if (row.scenario == scenario.name && row.condition == condition.condition) rows.emplace(row.Id(), &row);
  }
  std::map<std::size_t, std::vector<JudgedPerformance>> performances;
  for (const CellSeries& cell : run.series) {
    const auto row = rows.find(cell.cell);
    if (row == rows.end()) continue;
    const auto method = std::ranges::find(scenario.methods, row->second->method) - scenario.methods.begin();
    AddPerformances(cell, row->second->trial, performances[static_cast<std::size_t>(method)]);
  }
  std::erase_if(performances, [](const auto& entry) { return entry.second.empty(); });
  return performances;
}

std::string ShareLine(std::size_t method, const SharePoints& curve, const Axis& x, const Axis& y) {
  std::string path;
  for (const auto& [at, value] : curve)
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x.At(at), y.At(value));
  return fmt::format("<path class=\"line\" style=\"stroke:var(--m{})\"{} d=\"{}\"/>", method % kPlotColours.size(),
                     MarkDashes(method), path);
}

/// Lines of shares over shares, in per cent.
std::string SharePanel(const std::string& caption, const std::string& words,
                       const std::map<std::size_t, SharePoints>& curves) {
  const Axis x{.low = 0, .high = 1, .from = kPanelLeft, .to = kPanelRight},
      y{.low = 0, .high = 1, .from = kRocBottom, .to = kRocTop};
  std::string lines;
  for (const auto& [method, curve] : curves) {
    if (method < kMostRocs) lines += ShareLine(method, curve, x, y);
  }
  return fmt::format("<figure><figcaption>{}</figcaption>{}{}{}{}</svg></figure>", EscapeMarkup(caption),
                     BeginPanel(kRocHeight, words), UprightGrid(y), LyingGrid(x, kRocTop, kRocBottom), lines);
}

std::string ConditionPrefix(const ConditionSummary& condition) {
  const std::string label = ConditionLabel(condition.condition);
  return label.empty() ? "" : label + ": ";
}

std::string VerdictKey(const ScenarioSummary& scenario, std::size_t method, const std::string& told) {
  return fmt::format(
      "<span><svg class=\"linekey\" viewBox=\"0 0 28 10\" aria-hidden=\"true\"><path class=\"line\" "
      "style=\"stroke:var(--m{})\"{} d=\"M1 5H27\"/></svg>{} {}</span> ",
      method % kPlotColours.size(), MarkDashes(method), EscapeMarkup(MethodLabel(scenario, scenario.methods[method])),
      told);
}

std::string VerdictPanels(const RunData& run, const ScenarioSummary& scenario, const ConditionSummary& condition) {
  std::map<std::size_t, SharePoints> rocs, found;
  std::string words, found_words, keys;
  for (const auto& [method, performances] : PerformancesUnder(run, scenario, condition)) {
    if (method >= kMostRocs) continue;
    std::string told;
    if (const auto area = PooledArea(performances)) {
      rocs[method] = PooledRoc(performances);
      told += fmt::format("{:.3f} [{:.3f}, {:.3f}]", area->value, area->low, area->high);
      words += fmt::format("{}: area {:.3f}. ", scenario.methods[method], area->value);
    }
    const SharePoints by_severity = FoundBySeverity(performances);
    if (by_severity.size() > 1) {
      found[method] = by_severity;
      const auto half = HalfFoundAt(by_severity);
      if (half) told += fmt::format("; half found from severity {:.2f}", *half);
      found_words +=
          fmt::format("{}: {:.0f} % of the worst. ", scenario.methods[method], 100 * by_severity.back().second);
    }
    if (!told.empty()) keys += VerdictKey(scenario, method, told);
  }
  std::string html;
  if (!rocs.empty()) {
    html += SharePanel(ConditionPrefix(condition) +
                           "right performances called right over wrong ones called right, all thresholds, "
                           "all people together",
                       words, rocs);
  }
  if (!found.empty()) {
    html += SharePanel(ConditionPrefix(condition) + "faulty performances not called right, by how bad the fault is",
                       found_words, found);
  }
  if (html.empty()) return "";
  return fmt::format(
      "<div class=\"panels\">{}</div><p class=\"quiet legend units\">Area under the curve with 95 % "
      "interval over people: {}</p>",
      html, keys);
}

}  // namespace

std::vector<std::pair<double, double>> PooledRoc(std::span<const JudgedPerformance> performances) {
  std::vector<JudgedPerformance> sorted;
  double right = 0, wrong = 0;
  for (const JudgedPerformance& performance : performances) {
    if (performance.truth == 0.5) continue;
    sorted.push_back(performance);
    (performance.truth > 0.5 ? right : wrong) += 1;
  }
  if (right == 0 || wrong == 0) return {};
  std::ranges::stable_sort(sorted, std::ranges::greater{}, &JudgedPerformance::score);
  SharePoints curve{{0, 0}};
  double right_above = 0, wrong_above = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    (sorted[i].truth > 0.5 ? right_above : wrong_above) += 1;
    const bool ends_tie = i + 1 == sorted.size() || sorted[i + 1].score != sorted[i].score;
    if (ends_tie) curve.emplace_back(wrong_above / wrong, right_above / right);
  }
  return curve;
}

double AreaUnder(std::span<const std::pair<double, double>> curve) {
  double area = 0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    area += (curve[i].first - curve[i - 1].first) * 0.5 * (curve[i].second + curve[i - 1].second);
  }
  return area;
}

std::optional<WithInterval> PooledArea(std::span<const JudgedPerformance> performances) {
  const SharePoints all = PooledRoc(performances);
  if (all.empty()) return std::nullopt;
  std::map<int, std::vector<JudgedPerformance>> without;
  for (const JudgedPerformance& performance : performances) without[performance.person];
  for (auto& [person, others] : without) {
    std::ranges::copy_if(performances, std::back_inserter(others),
                         [person = person](const JudgedPerformance& each) { return each.person != person; });
  }
  std::vector<double> areas;
  for (const auto& [person, others] : without) {
    const SharePoints curve = PooledRoc(others);
    if (curve.empty()) return std::nullopt;
    areas.push_back(AreaUnder(curve));
  }
  double mean = 0, squares = 0;
  for (double area : areas) mean += area / static_cast<double>(areas.size());
  for (double area : areas) squares += (area - mean) * (area - mean);
  const auto count = static_cast<double>(areas.size());
  const double reach = 1.96 * std::sqrt((count - 1) / count * squares);
  const double value = AreaUnder(all);
  return WithInterval{value, std::max(0.0, value - reach), std::min(1.0, value + reach)};
}

std::vector<std::pair<double, double>> FoundBySeverity(std::span<const JudgedPerformance> performances) {
  constexpr std::size_t kFifths = 5;
  std::array<int, kFifths> all{}, found{};
  for (const JudgedPerformance& performance : performances) {
    if (!(performance.severity > 0)) continue;
    const auto fifth = std::min(kFifths - 1, static_cast<std::size_t>(performance.severity * kFifths));
    ++all[fifth];
    found[fifth] += !performance.is_called;
  }
  SharePoints curve;
  for (std::size_t i = 0; i < kFifths; ++i) {
    if (all[i] > 0)
      curve.emplace_back((static_cast<double>(i) + 0.5) / kFifths, found[i] / static_cast<double>(all[i]));
  }
  return curve;
}

std::optional<double> HalfFoundAt(std::span<const std::pair<double, double>> curve) {
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const auto [x0, y0] = curve[i - 1];
    const auto [x1, y1] = curve[i];
    if (y0 < 0.5 && y1 >= 0.5) return x0 + (x1 - x0) * (0.5 - y0) / (y1 - y0);
  }
  return std::nullopt;
}

std::string VerdictCurvesHtml(const RunData& run, const ScenarioSummary& scenario) {
  std::string html;
  std::size_t count = 0;
  for (const ConditionSummary& condition : scenario.conditions) {
    if (count == kMostConditions) break;
    const std::string panels = VerdictPanels(run, scenario, condition);
    html += panels;
    count += !panels.empty();
  }
  return html.empty() ? "" : "<div class=\"verdicts\">" + html + "</div>";
}

}  // namespace etude
