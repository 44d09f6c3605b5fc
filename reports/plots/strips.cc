#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/order_statistics.h"
#include "io/drawing/escape.h"
#include "io/drawing/marks.h"
#include "io/drawing/panel.h"
#include "reports/plots/plot_section.h"
#include "reports/words/cell_series.h"
#include "reports/words/figures.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

constexpr double kRow = 40, kLabel = 13, kSpread = 9, kFoot = 20;
constexpr std::size_t kMaxDots = 100;  // maximum number of dots per row

struct Dot {
  int trial = 0;
  double value = 0;
  std::string cell = {};  ///< HTML attribute that links the dot to its cell, if the cell was recorded
};

/// A row with the dots of one method, and the quartiles and the median or mean of all values of this method.
struct StripRow {
  std::size_t method = 0;  ///< index of the method in the scenario
  std::vector<Dot> dots = {};
  std::size_t total = 0;
  double low = 0, typical = 0, high = 0;  ///< lower quartile, median or mean, upper quartile
};

StripRow RowOf(std::size_t method, const std::vector<Dot>& dots, const MetricWords& words) {
  std::vector<double> sorted;
  for (const Dot& dot : dots) sorted.push_back(dot.value);
  std::ranges::sort(sorted);
  StripRow row{.method = method, .total = dots.size(), .low = Quantile(sorted, 0.25), .high = Quantile(sorted, 0.75)};
  row.typical = words.by_mean ? std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(sorted.size())
                              : Quantile(sorted, 0.5);
  const std::size_t stride = StrideFor(dots.size(), kMaxDots);
  for (std::size_t i = 0; i < dots.size(); i += stride) row.dots.push_back(dots[i]);
  return row;
}

std::vector<StripRow> RowsOf(const RunData& run, const ScenarioSummary& scenario, const ConditionSummary& condition,
                             const std::string& metric, const MetricWords& words) {
  std::vector<std::vector<Dot>> dots(std::min(scenario.methods.size(), kMaxListed));
  const KeptCells kept(run);
  for (const Row* row : RowsUnder(run, scenario.name, condition.condition)) {
    const std::size_t index = IndexOf(scenario, row->method);
    const auto value = ValueOf(*row, metric);
    if (index < dots.size() && value && std::isfinite(*value))
      dots[index].push_back({row->trial, words.scale * *value, kept.Attribute(row->Id())});
  }
  std::vector<StripRow> rows;
  for (std::size_t i = 0; i < dots.size(); ++i) {
    if (!dots[i].empty()) rows.push_back(RowOf(i, dots[i], words));
  }
  return rows;
}

std::string Strip(const StripRow& row, const Axis& axis, double top, const ScenarioSummary& scenario,
                  const MetricWords& words) {
  const std::string& method = scenario.methods[row.method];
  const double middle = top + kLabel + kSpread + 4;
  std::vector<double> places;
  for (const Dot& dot : row.dots) places.push_back(axis.At(dot.value));
  const std::vector<double> aside = SwarmOffsets(places, kSpread);
  const std::string label = fmt::format("{} {}", MethodLabel(scenario, method), FormatNumber(row.typical));
  std::string svg = PanelText(2, top + 10, label, "start", 48) + fmt::format("<g data-m=\"{}\">", EscapeMarkup(method));
  for (std::size_t i = 0; i < places.size(); ++i) {
    svg += MarkUse(row.method, row.method, places[i], middle + aside[i],
                   fmt::format(" data-t=\"{}\"{} data-v=\"{}{}\"", row.dots[i].trial, row.dots[i].cell,
                               FormatNumber(row.dots[i].value), EscapeMarkup(words.suffix)));
  }
  const double from = axis.At(row.low), to = axis.At(row.high), at = axis.At(row.typical);
  return svg +
         fmt::format("</g><path class=\"box\" d=\"M{:.1f} {:.1f}V{:.1f}M{:.1f} {:.1f}V{:.1f}M{:.1f} {:.1f}H{:.1f}\"/>",
                     from, middle - 4, middle + 4, to, middle - 4, middle + 4, from, middle, to) +
         fmt::format("<path class=\"typical\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>", at, middle - kSpread - 2,
                     middle + kSpread + 2);
}

std::string Caption(const ConditionSummary& condition, const MetricWords& words, const std::vector<StripRow>& rows) {
  const std::string unit = UnitOf(words);
  std::string text = ConditionLabel(condition.condition);
  text += fmt::format("{}{}{}", text.empty() ? "" : ": ", words.plain_label, unit.empty() ? "" : ", " + unit);
  const std::string_view direction = DirectionWords(words.direction);
  if (!direction.empty()) text += fmt::format("; {}", direction);
  const bool is_thinned = std::ranges::any_of(rows, [](const StripRow& row) { return row.dots.size() < row.total; });
  return text + (is_thinned ? fmt::format(" (each row shows at most {} dots, at equal steps)", kMaxDots) : "");
}

}  // namespace

std::string StripsHtml(const RunData& run, const ScenarioSummary& scenario, const ConditionSummary& condition,
                       const std::string& metric) {
  const MetricWords words = WordsFor(metric);
  const std::vector<StripRow> rows = RowsOf(run, scenario, condition, metric, words);
  if (rows.empty()) return "";
  std::vector<double> all;
  for (const StripRow& row : rows) {
    for (const Dot& dot : row.dots) all.push_back(dot.value);
    all.insert(all.end(), {row.low, row.typical, row.high});
  }
  const MetricInfo* info = FindMetric(metric);
  const bool is_cost = info != nullptr && !words.is_share && words.direction == Direction::kLowerIsBetter;
  Axis axis = AxisOf(all, is_cost ? info->practical * words.scale / 100 : 0);
  axis.from = 10, axis.to = kPanelRight;
  const double bottom = kRow * static_cast<double>(rows.size());
  std::string strips, described;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string name = MethodLabel(scenario, scenario.methods[rows[i].method]);
    strips += Strip(rows[i], axis, kRow * static_cast<double>(i), scenario, words);
    described += fmt::format("{}: {}{}. ", name, FormatNumber(rows[i].typical), words.suffix);
  }
  return fmt::format(
      "<figure class=\"worlds\" data-s=\"{}\" data-c=\"{}\"><figcaption>{}</figcaption>{}{}{}</svg></figure>",
      EscapeMarkup(scenario.name), EscapeMarkup(CompactLabel(condition.condition)),
      EscapeMarkup(Caption(condition, words, rows)), BeginPanel(bottom + kFoot, described),
      HorizontalAxisGrid(axis, 0, bottom), strips);
}

}  // namespace etude
