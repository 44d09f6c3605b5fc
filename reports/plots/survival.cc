#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

#include "bench/statistics/curves/curves.h"
#include "io/drawing/escape.h"
#include "io/drawing/marks.h"
#include "io/drawing/panel.h"
#include "reports/plots/plot_section.h"
#include "reports/words/cell_series.h"
#include "reports/words/figures.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

constexpr double kCurveHeight = 200, kCurveTop = 8, kCurveBottom = 172;
constexpr std::size_t kMaxPanels = 4;
constexpr std::size_t kMaxLines = 16;

/// A metric that measures the time until an event, and is censored: the measurement may stop before the event happens.
struct Censored {
  std::string_view metric;
  std::string_view done;   ///< a metric that is 1 if the event happened; "" if every value means that it happened
  std::string_view share;  ///< label of the vertical axis, which shows a share of the cells
  std::string_view never;  ///< name of the cells in which the event never happened
};
constexpr std::array<Censored, 2> kCensored = {
    {{"iterations", "solved_practical", "worlds not yet solved", "Worlds that were never solved"},
     {"wait_s", "", "requests still waiting", "Requests without a transition"}}};

/// Returns the time until the event happened in the cell, infinite if the event never happened; nullopt for a skipped
/// cell.
std::optional<Wait> WaitOf(const Row& row, const Censored& rule) {
  if (row.result.status == Status::kSkipped) return std::nullopt;
  const auto took = ValueOf(row, rule.metric);
  const bool is_done = took && (rule.done.empty() || ValueOf(row, rule.done) == 1);
  return is_done ? Wait{*took, true} : Wait{std::numeric_limits<double>::infinity(), false};
}

/// Returns the times until the event by method, in the scenario's order; methods that never measure this metric are
/// left out.
std::map<std::size_t, std::vector<Wait>> WaitsUnder(const RunData& run, const ScenarioSummary& scenario,
                                                    const ConditionSummary& condition, const Censored& rule) {
  std::map<std::size_t, std::vector<Wait>> waits;
  std::set<std::size_t> measured;
  for (const Row* row : RowsUnder(run, scenario.name, condition.condition)) {
    const auto wait = WaitOf(*row, rule);
    if (!wait) continue;
    const std::size_t method = IndexOf(scenario, row->method);
    waits[method].push_back(*wait);
    if (ValueOf(*row, rule.metric)) measured.insert(method);
  }
  std::erase_if(waits, [&](const auto& entry) { return !measured.contains(entry.first); });
  return waits;
}

std::string Line(std::size_t method, const std::vector<Wait>& waits, const Axis& time, const Axis& share) {
  std::string path;
  for (const auto& [at, left] : SurvivalCurve(waits)) {
    if (path.empty()) {
      path = fmt::format("M{:.1f} {:.1f}", time.from, share.At(100 * left));
    } else {
      path += fmt::format("H{:.1f}V{:.1f}", time.At(at), share.At(100 * left));
    }
  }
  return MethodLine(method, fmt::format("{}H{:.1f}", path, time.to));
}

std::string PanelOf(const RunData& run, const ScenarioSummary& scenario, const ConditionSummary& condition,
                    const Censored& rule) {
  const auto waits = WaitsUnder(run, scenario, condition, rule);
  std::vector<double> times;
  bool is_censored = false;
  for (const auto& [method, of_method] : waits) {
    for (const Wait& wait : of_method) {
      is_censored |= !wait.happened;
      if (wait.happened) times.push_back(wait.seconds);
    }
  }
  if (times.empty() || !is_censored) return "";
  const MetricInfo* info = FindMetric(rule.metric);
  Axis time = AxisOf(times, info->practical / 100), share{.low = 0, .high = 100, .from = kCurveBottom, .to = kCurveTop};
  if (!time.is_logarithmic) time.low = 0;
  time.from = kPanelLeft, time.to = kPanelRight;
  std::string lines, described;
  for (const auto& [method, of_method] : waits) {
    if (method >= kMaxLines) continue;
    lines += Line(method, of_method, time, share);
    described += fmt::format("{}: {:.0f} % remain at the end. ", scenario.methods[method],
                             100 * SurvivalCurve(of_method).back().second);
  }
  const std::string condition_label = ConditionLabel(condition.condition);
  const MetricWords words = WordsFor(std::string(rule.metric));
  return fmt::format(
      "<figure><figcaption>{}{}: {}, per cent, by {}{}. {} count in the "
      "denominator.</figcaption>{}{}{}{}</svg></figure>",
      EscapeMarkup(condition_label), condition_label.empty() ? "How long it takes" : "", rule.share,
      EscapeMarkup(words.plain_label), words.suffix.empty() ? "" : " (" + words.suffix.substr(1) + ")", rule.never,
      BeginPanel(kCurveHeight, described), VerticalAxisGrid(share), HorizontalAxisGrid(time, kCurveTop, kCurveBottom),
      lines);
}

std::string SectionOf(const RunData& run, const ScenarioSummary& scenario, const Censored& rule) {
  std::string panels, keys;
  std::size_t count = 0;
  for (const ConditionSummary& condition : scenario.conditions) {
    const std::string panel = count < kMaxPanels ? PanelOf(run, scenario, condition, rule) : "";
    panels += panel;
    count += !panel.empty();
  }
  if (panels.empty()) return "";
  for (std::size_t i = 0; i < std::min(scenario.methods.size(), kMaxLines); ++i) {
    keys += fmt::format("<span>{}{}</span> ", LineKeySvg(i), EscapeMarkup(MethodLabel(scenario, scenario.methods[i])));
  }
  return fmt::format("<div class=\"panels\">{}</div><p class=\"quiet legend units\">{}</p>", panels, keys);
}

}  // namespace

std::string SurvivalHtml(const RunData& run, const ScenarioSummary& scenario) {
  std::string html;
  for (const Censored& rule : kCensored) html += SectionOf(run, scenario, rule);
  return html.empty() ? "" : fmt::format("<div class=\"survival\">{}</div>", html);
}

}  // namespace etude
