#include "reports/plots/plot_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "reports/plots/estimation.h"
#include "reports/plots/verdict_curves.h"
#include "reports/plots/verdict_tables.h"
#include "reports/words/answer.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

constexpr std::size_t kMostOpen = 4;    // conditions whose pictures are not folded away
constexpr std::size_t kMostFolded = 8;  // plots
constexpr std::size_t kMostStrips = 12;

std::string Folded(std::string_view title, const std::string& html) {
  return html.empty() ? "" : fmt::format("<details><summary>{}</summary>{}</details>", title, html);
}

std::string PlotOf(const RunData& run, const ScenarioSummary& scenario, const Judged& judged) {
  return EstimationHtml(scenario, judged, PairedWorldsOf(run, scenario, judged)) +
         LeftOutStripHtml(*judged.comparison, scenario.unit);
}

/// The pictures that stand open, and those that are folded away.
class Section {
 public:
  Section(const RunData& run, const ScenarioSummary& scenario) : run_(run), scenario_(scenario) {}

  void Add(const Judged& judged, std::size_t condition, bool is_asked) {
    if (is_asked && condition < kMostOpen) {
      open_ += PlotOf(run_, scenario_, judged);
      return;
    }
    if (++folded_count_ <= kMostFolded) folded_ += PlotOf(run_, scenario_, judged);
  }

  std::string Html() const {
    return open_ +
           Folded("The other comparisons, world by world",
                  folded_.empty() ? "" : folded_ + LeftOutHtml(folded_count_, kMostFolded, "plots", "cells.jsonl"));
  }

 private:
  const RunData& run_;
  const ScenarioSummary& scenario_;
  std::string open_, folded_;
  std::size_t folded_count_ = 0;
};

std::string Comparisons(const RunData& run, const ScenarioSummary& scenario, const std::string& metric) {
  Section section(run, scenario);
  const std::string asked = MethodInQuestion(scenario);
  const auto add_all = [&](const std::string& method, Against against, const std::string& by, bool is_asked) {
    const std::vector<Judged> judged = JudgedOf(scenario, method, by, against);
    for (std::size_t i = 0; i < judged.size(); ++i) {
      const auto baseline = JudgedOf(scenario, method, by, Against::kBaseline);
      // A rival that is the baseline has its plot already.
      if (against == Against::kRival && i < baseline.size() &&
          baseline[i].comparison->baseline == judged[i].comparison->baseline) {
        continue;
      }
      section.Add(judged[i], i, is_asked);
    }
  };
  add_all(asked, Against::kBaseline, metric, true);
  add_all(asked, Against::kRival, metric, true);
  for (const std::string& method : scenario.methods) {
    if (method != asked) add_all(method, Against::kBaseline, metric, false);
  }
  for (const std::string& other : scenario.headline_metrics) {
    if (other != metric) add_all(asked, Against::kBaseline, other, false);
  }
  return section.Html();
}

std::string Strips(const RunData& run, const ScenarioSummary& scenario, const std::string& metric) {
  std::string open, folded;
  for (std::size_t i = 0; i < std::min(scenario.conditions.size(), kMostStrips); ++i) {
    (i < kMostOpen ? open : folded) += StripsHtml(run, scenario, scenario.conditions[i], metric);
  }
  if (open.empty()) return "";
  if (!folded.empty()) folded = "<div class=\"panels\">" + folded + "</div>";
  return fmt::format("<div class=\"panels\">{}</div>", open) + Folded("The same under the other conditions", folded);
}

// Each with the condition that it is of, where there are several.
std::string Budgets(const ScenarioSummary& scenario) {
  std::string html;
  std::size_t count = 0;
  for (const ConditionSummary& condition : scenario.conditions) {
    std::string label;
    for (const SweptValue& swept : condition.condition) {
      label += (label.empty() ? "" : ", ") + swept.key + " = " + swept.value;
    }
    for (const ErrorBudget& budget : condition.budgets) {
      if (++count <= kMostStrips) html += ErrorBudgetHtml(budget, label);
    }
  }
  if (html.empty()) return "";
  return "<div class=\"panels\">" + html + "</div>" + LeftOutHtml(count, kMostStrips, "error budgets", "summary.json");
}

}  // namespace

std::string PlotSectionHtml(const RunData& run, const ScenarioSummary& scenario) {
  if (scenario.headline_metrics.empty()) return "";
  const std::string& metric = scenario.headline_metrics.front();
  const std::string strips = Strips(run, scenario, metric);
  if (strips.empty()) return "";
  return fmt::format("<div class=\"plots\">{}{}{}{}{}{}</div>", strips, VerdictCurvesHtml(run, scenario),
                     VerdictTablesHtml(run, scenario), Budgets(scenario), Comparisons(run, scenario, metric),
                     SurvivalHtml(run, scenario));
}

}  // namespace etude
