#include "reports/plots/plot_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/drawing/escape.h"
#include "reports/plots/verdicts.h"
#include "reports/words/answer.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

constexpr std::size_t kMaxPlots = 8;
constexpr std::size_t kMaxStrips = 12;

/// Returns the index of the condition under which the method in question differs most from its baseline.
std::size_t LeadCondition(const ScenarioSummary& scenario, const std::string& metric) {
  std::size_t lead = 0;
  double largest = -1;
  const std::vector<Judged> judged = JudgedOf(scenario, MethodInQuestion(scenario), metric, Against::kBaseline);
  for (const Judged& j : judged) {
    const double size = std::abs(j.comparison->difference.value_or(0));
    if (size <= largest) continue;
    largest = size;
    lead = static_cast<std::size_t>(j.condition - scenario.conditions.data());
  }
  return lead;
}

/// Collects plots of comparisons, and explains each kind of plot only once. Each pair of methods appears once for each
/// condition.
class Section {
 public:
  Section(const RunData& run, const ScenarioSummary& scenario) : run_(run), scenario_(scenario) {}

  void AddAll(const std::string& method, Against against, const std::string& metric) {
    const std::vector<Judged> baselines = JudgedOf(scenario_, method, metric, Against::kBaseline);
    for (const Judged& judged : JudgedOf(scenario_, method, metric, against)) {
      const bool is_drawn = std::ranges::any_of(baselines, [&](const Judged& other) {
        return other.condition == judged.condition && other.comparison->baseline == judged.comparison->baseline;
      });
      if (against == Against::kRival && is_drawn) continue;
      if (++count_ <= kMaxPlots) Add(judged);
    }
  }

  std::string Html() const { return html_ + LeftOutHtml(count_, kMaxPlots, "plots", "cells.jsonl"); }

 private:
  void Add(const Judged& judged) {
    const PairedDots pairs = PairedWorldsOf(run_, scenario_, judged);
    const std::string plot = EstimationHtml(scenario_, judged, pairs);
    if (plot.empty()) return;
    const std::string& metric = judged.comparison->metric;
    if (metric != explained_) {
      html_ += "<p class=\"quiet legend\">" + EscapeMarkup(EstimationLegend(scenario_, metric)) + "</p>";
      explained_ = metric;
    }
    if (std::string units = UnitLegendHtml(pairs); units != units_) html_ += units_ = std::move(units);
    html_ += plot;
    const bool is_asked = judged.comparison->method == MethodInQuestion(scenario_);
    if (is_asked && metric == scenario_.headline_metrics.front()) {
      html_ += LeftOutStripHtml(*judged.comparison, scenario_.unit);
    }
  }

  const RunData& run_;
  const ScenarioSummary& scenario_;
  std::string html_, explained_, units_;
  std::size_t count_ = 0;
};

std::string Comparisons(const RunData& run, const ScenarioSummary& scenario, const std::string& metric) {
  Section section(run, scenario);
  const std::string asked = MethodInQuestion(scenario);
  section.AddAll(asked, Against::kBaseline, metric);
  section.AddAll(asked, Against::kRival, metric);
  for (const std::string& method : scenario.methods) {
    if (method != asked) section.AddAll(method, Against::kBaseline, metric);
  }
  for (const std::string& other : scenario.headline_metrics) {
    if (other != metric) section.AddAll(asked, Against::kBaseline, other);
  }
  return section.Html();
}

std::string OtherStrips(const RunData& run, const ScenarioSummary& scenario, const std::string& metric) {
  const std::size_t lead = LeadCondition(scenario, metric);
  std::string html;
  for (std::size_t i = 0; i < std::min(scenario.conditions.size(), kMaxStrips); ++i) {
    if (i != lead) html += StripsHtml(run, scenario, scenario.conditions[i], metric);
  }
  return html.empty() ? "" : "<div class=\"panels\">" + html + "</div>";
}

// Draws the error budgets; if there are several conditions, the label of each budget states the condition.
std::string Budgets(const ScenarioSummary& scenario) {
  std::string html;
  std::size_t count = 0;
  for (const ConditionSummary& condition : scenario.conditions) {
    std::string label;
    for (const SweptValue& swept : condition.condition) {
      label += (label.empty() ? "" : ", ") + swept.key + " = " + swept.value;
    }
    for (const ErrorBudget& budget : condition.budgets) {
      if (++count <= kMaxStrips) html += ErrorBudgetHtml(budget, label);
    }
  }
  if (html.empty()) return "";
  return "<div class=\"panels\">" + html + "</div>" + LeftOutHtml(count, kMaxStrips, "error budgets", "summary.json");
}

}  // namespace

std::string LeadPictureHtml(const RunData& run, const ScenarioSummary& scenario) {
  if (scenario.headline_metrics.empty() || scenario.conditions.empty()) return "";
  const std::string& metric = scenario.headline_metrics.front();
  return StripsHtml(run, scenario, scenario.conditions[LeadCondition(scenario, metric)], metric);
}

std::string PlotSectionHtml(const RunData& run, const ScenarioSummary& scenario) {
  if (scenario.headline_metrics.empty()) return "";
  const std::string& metric = scenario.headline_metrics.front();
  return OtherStrips(run, scenario, metric) + Comparisons(run, scenario, metric) + Budgets(scenario) +
         SurvivalHtml(run, scenario) + VerdictCurvesHtml(run, scenario) + VerdictTablesHtml(run, scenario);
}

}  // namespace etude
