#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "io/drawing/escape.h"
#include "io/drawing/panel.h"
#include "reports/plots/plot_section.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

constexpr double kBarStep = 24, kBarHeight = 12, kStageNames = 120;

/// One bar of the waterfall chart. It runs from the error before the truth replaces a stage to the error after this
/// replacement.
struct Bar {
  std::string name;
  double from = 0, to = 0;
  /// The stage's cost; null for the first bar (the whole error) and the last bar (the remaining error)
  const BudgetShare* share = nullptr;
};

std::vector<Bar> BarsOf(const ErrorBudget& budget, double scale) {
  std::vector<Bar> bars{{budget.method, 0, budget.total * scale}};
  double left = budget.total;
  for (const BudgetShare& share : budget.shares) {
    bars.push_back({share.stage, left * scale, (left - share.mean) * scale, &share});
    left -= share.mean;
  }
  bars.push_back({"remaining error", 0, budget.rest * scale});
  return bars;
}

std::string Describe(const ErrorBudget& budget, const MetricWords& words) {
  std::string text = fmt::format("“{}”: {}{}, the mean of {} worlds.", budget.method,
                                 FormatNumber(budget.total * words.scale), words.suffix, budget.worlds);
  for (const BudgetShare& share : budget.shares) {
    text += fmt::format(" {}: {}", share.stage, FormatNumber(share.mean * words.scale));
    if (share.ci_low && share.ci_high) {
      text += fmt::format(" ({} to {})", FormatNumber(*share.ci_low * words.scale),
                          FormatNumber(*share.ci_high * words.scale));
    }
    text += ".";
  }
  return text + fmt::format(" Remaining error: {}.", FormatNumber(budget.rest * words.scale));
}

std::string BarSvg(const Bar& bar, double y, const Axis& axis, double scale) {
  const double low = std::min(axis.At(bar.from), axis.At(bar.to)), high = std::max(axis.At(bar.from), axis.At(bar.to));
  std::string svg = PanelText(kStageNames - 6, y + kBarHeight - 2, bar.name, "end", 22);
  svg += fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\"/>",
                     bar.share == nullptr ? "budget whole"
                     : bar.to > bar.from  ? "budget worse"
                                          : "budget",
                     low, y, std::max(1.0, high - low), kBarHeight);
  if (bar.share == nullptr || !bar.share->ci_low) return svg;
  const double middle = y + 0.5 * kBarHeight;
  return svg + fmt::format("<path class=\"budget-interval\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>",
                           axis.At(bar.from - *bar.share->ci_low * scale), middle,
                           axis.At(bar.from - *bar.share->ci_high * scale));
}

}  // namespace

std::string ErrorBudgetHtml(const ErrorBudget& budget, const std::string& condition) {
  const MetricWords words = WordsFor(budget.metric);
  const std::vector<Bar> bars = BarsOf(budget, words.scale);
  // Make an axis that contains every bar and every bar's interval.
  std::vector<double> values{0};
  for (const Bar& bar : bars) {
    values.push_back(bar.to);
    if (bar.share == nullptr || !bar.share->ci_low) continue;
    values.push_back(bar.from - *bar.share->ci_low * words.scale);
    values.push_back(bar.from - *bar.share->ci_high * words.scale);
  }
  Axis axis = AxisAroundZero(values);
  axis.from = kStageNames, axis.to = kPanelRight;
  // Draw one bar for the whole error, one for every stage, and one for the remaining error.
  const double bottom = kBarStep * static_cast<double>(bars.size()) + 4;
  std::string svg = BeginPanel(bottom + 18, Describe(budget, words)) + HorizontalAxisGrid(axis, 0, bottom);
  double y = 6;
  for (const Bar& bar : bars) {
    svg += BarSvg(bar, y, axis, words.scale);
    y += kBarStep;
  }
  const std::string order = budget.is_shapley ? "the bars are Shapley values, which are the error that is saved if the "
                                                "stage is replaced by the truth, averaged over all orders of the stages"
                                              : "the stages are replaced by the truth one after the other, from top to "
                                                "bottom; another order may give other values";
  return fmt::format(
      "<figure><figcaption>Contribution of each stage to the {}{}{}: {}. Values are means of {} worlds; lines are 95 % "
      "intervals.</figcaption>{}</svg></figure>",
      EscapeMarkup(words.label), condition.empty() ? "" : ", ", EscapeMarkup(condition), order, budget.worlds, svg);
}

}  // namespace etude
