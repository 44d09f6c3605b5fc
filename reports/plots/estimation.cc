#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "io/drawing/escape.h"
#include "io/drawing/marks.h"
#include "io/drawing/panel.h"
#include "reports/plots/plot_section.h"
#include "reports/words/cell_series.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

struct Found {
  const Row* row = nullptr;
  std::optional<double> baseline, method;
  std::string baseline_cell, method_cell;
};

std::vector<std::string> UnitNames(const std::map<int, Found>& found) {
  std::set<std::string> names;
  for (const auto& [trial, world] : found) {
    if (!world.row->units.empty()) names.insert(world.row->units.front());
  }
  return {names.begin(), names.end()};
}

constexpr double kHeight = 250, kTop = 8, kBottom = 212;
constexpr double kSwarm = 26;  // maximum sideways offset of overlapping dots, in units of the plot
constexpr std::size_t kMaxNamed = 16;

/// The indices, in the scenario, of the two methods of a comparison. They select the methods' colours and marks.
struct MethodIndices {
  std::size_t baseline = 0, method = 0;
};

class Plot {
 public:
  Plot(const ScenarioSummary& scenario, const Judged& judged, const PairedDots& pairs)
      : scenario_(scenario),
        c_(*judged.comparison),
        pairs_(pairs),
        words_(WordsFor(c_.metric)),
        indices_{IndexOf(scenario, c_.baseline), IndexOf(scenario, c_.method)} {}

  std::string Values() const {
    std::vector<double> all;
    for (const PairedWorld& world : pairs_.worlds) all.insert(all.end(), {world.baseline, world.method});
    Axis axis = AxisOf(all, Floor());
    axis.from = kBottom, axis.to = kTop;
    const std::vector<double> left = Column(axis, &PairedWorld::baseline), right = Column(axis, &PairedWorld::method);
    std::string lines, dots;
    for (std::size_t i = 0; i < pairs_.worlds.size(); ++i) {
      const PairedWorld& world = pairs_.worlds[i];
      const double y1 = axis.At(world.baseline), y2 = axis.At(world.method);
      lines += fmt::format("M{:.0f} {:.1f}L{:.0f} {:.1f}", kBaselineX + left[i], y1, kMethodX + right[i], y2);
      dots += Dot(indices_.baseline, world, world.baseline_cell, kBaselineX + left[i], y1, "") +
              Dot(indices_.method, world, world.method_cell, kMethodX + right[i], y2, "");
    }
    return BeginPanel(kHeight, fmt::format("{} under both methods", words_.plain_label)) + VerticalAxisGrid(axis) +
           fmt::format("<path class=\"pairs\" d=\"{}\"/>", lines) + dots +
           PanelText(kBaselineX, kBottom + 18, c_.baseline, "middle", 22) +
           PanelText(kMethodX, kBottom + 18, c_.method, "middle", 22) + "</svg>";
  }

  std::string Differences() const {
    // Make an axis that contains all differences and intervals.
    std::vector<double> all, places;
    for (const PairedWorld& world : pairs_.worlds) all.push_back(world.Difference());
    const double practical = Practical();
    for (const auto& end : {c_.ci_low, c_.ci_high, c_.beyond.low, c_.beyond.high}) {
      if (end) all.push_back(*end * words_.scale);
    }
    Axis axis = AxisAroundZero(all);
    axis.from = kBottom, axis.to = kTop;
    // Draw one dot per world, and a band for differences below the practical threshold.
    for (const PairedWorld& world : pairs_.worlds) places.push_back(axis.At(world.Difference()));
    const std::vector<double> aside = SwarmOffsets(places, kSwarm);
    std::string dots;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const PairedWorld& world = pairs_.worlds[i];
      dots += Dot(indices_.method, world, world.method_cell, kWorldsX + aside[i], places[i], Title(world));
    }
    const double high = axis.At(practical), low = axis.At(-practical);
    const std::string band = fmt::format("<rect class=\"band\" x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\"/>",
                                         kPanelLeft, high, kPanelRight - kPanelLeft, std::max(1.0, low - high));
    return BeginPanel(kHeight, fmt::format("paired differences, {} minus {}", c_.method, c_.baseline)) + band +
           VerticalAxisGrid(axis) +
           fmt::format("<path class=\"zero\" d=\"M{} {:.1f}H{}\"/>", kPanelLeft, axis.At(0), kPanelRight) + dots +
           Interval(axis, kAggregateX, c_.difference, c_.ci_low, c_.ci_high) + Units(axis) +
           PanelText(kWorldsX, kBottom + 18, "each world", "middle") +
           PanelText(kAggregateX, kBottom + 18, words_.by_mean ? "their mean" : "their median", "middle") +
           (ShowsUnits() ? PanelText(kUnitsX, kBottom + 18, UnitsWords(), "middle") : "") + "</svg>";
  }

 private:
  static constexpr double kBaselineX = 115, kMethodX = 265;
  static constexpr double kWorldsX = 100, kAggregateX = 195, kUnitsX = 282;

  double Practical() const {
    const MetricInfo* info = FindMetric(c_.metric);
    return info == nullptr ? 0 : info->practical * words_.scale;
  }
  // Returns the lower end of a logarithmic axis of costs. Costs below a hundredth of the practical threshold are drawn
  // at this end, because the plot need not distinguish such small costs.
  double Floor() const {
    return words_.is_share || words_.direction != Direction::kLowerIsBetter ? 0 : Practical() / 100;
  }
  bool ShowsUnits() const { return !pairs_.units.empty(); }
  std::string_view UnitsWords() const {
    if (scenario_.unit == SamplingUnit::kRecordedPerson) return "over people";
    return scenario_.unit == SamplingUnit::kLibrary ? "over libraries" : "over clips";
  }

  std::vector<double> Column(const Axis& axis, double PairedWorld::*value) const {
    std::vector<double> places;
    for (const PairedWorld& world : pairs_.worlds) places.push_back(axis.At(world.*value));
    return SwarmOffsets(places, kSwarm);
  }

  std::string Title(const PairedWorld& world) const {
    const std::string unit = ShowsUnits() ? " · " + pairs_.units[world.unit] : "";
    return fmt::format("trial {}{}: {} → {}{}", world.trial, unit, FormatNumber(world.baseline),
                       FormatNumber(world.method), words_.suffix);
  }

  std::string Dot(std::size_t shape, const PairedWorld& world, const std::string& cell, double x, double y,
                  const std::string& title) const {
    return MarkUse(shape, ShowsUnits() ? world.unit : shape, x, y, fmt::format(" data-t=\"{}\"{}", world.trial, cell),
                   title);
  }

  /// Draws a bar from `low` to `high` with a dot for the estimate, all in the metric's unit.
  std::string Interval(const Axis& axis, double x, const std::optional<double>& estimate,
                       const std::optional<double>& low, const std::optional<double>& high) const {
    if (!estimate) return "";
    const auto at = [&](double value) { return axis.At(value * words_.scale); };
    std::string svg;
    if (low && high) svg = fmt::format("<path class=\"interval\" d=\"M{} {:.1f}V{:.1f}\"/>", x, at(*low), at(*high));
    return svg + fmt::format("<circle class=\"estimate\" cx=\"{}\" cy=\"{:.1f}\" r=\"4.5\"/>", x, at(*estimate));
  }

  /// Draws the mean difference of each sampling unit (clip, person, …) as a dot, and beside the dots the difference and
  /// interval generalised over units.
  std::string Units(const Axis& axis) const {
    if (!ShowsUnits()) return "";
    // If the sampling units are pairs of clips, show only the interval: each world belongs to two clips, so a clip has
    // no mean difference of its own.
    std::string interval = Interval(axis, kUnitsX + 10, c_.beyond.difference, c_.beyond.low, c_.beyond.high);
    if (scenario_.unit == SamplingUnit::kClipPair) return interval;
    std::map<std::size_t, std::pair<double, int>> sums;
    for (const PairedWorld& world : pairs_.worlds) {
      sums[world.unit].first += world.Difference();
      ++sums[world.unit].second;
    }
    std::string dots;
    std::vector<double> places;
    for (const auto& [unit, sum] : sums) places.push_back(axis.At(sum.first / sum.second));
    const std::vector<double> aside = SwarmOffsets(places, kSwarm / 2);
    std::size_t i = 0;
    for (const auto& [unit, sum] : sums) {
      const double mean = sum.first / sum.second;
      dots += MarkUse(indices_.method, unit, kUnitsX - 22 + aside[i], places[i], "",
                      fmt::format("{}: mean {}{} over {}", pairs_.units[unit], FormatNumber(mean),
                                  words_.difference_suffix, Plural(sum.second, "world")));
      ++i;
    }
    return dots + interval;
  }

  const ScenarioSummary& scenario_;
  const Comparison& c_;
  const PairedDots& pairs_;
  MetricWords words_;
  MethodIndices indices_;
};

std::string Caption(const Judged& judged, const PairedDots& pairs) {
  const Comparison& c = *judged.comparison;
  const MetricWords words = WordsFor(c.metric);
  const std::string unit = UnitOf(words), condition = ConditionLabel(judged.condition->condition);
  std::string text = fmt::format("“{}” against “{}”{}{}: {}{}{}", c.method, c.baseline, condition.empty() ? "" : ", ",
                                 condition, words.plain_label, unit.empty() ? "" : ", ", unit);
  if (pairs.worlds.size() < pairs.total) {
    text += fmt::format(" ({} of {} worlds are drawn, at equal steps)",
                        FormatCount(static_cast<long long>(pairs.worlds.size())),
                        FormatCount(static_cast<long long>(pairs.total)));
  }
  return text;
}

constexpr double kStripHeight = 58, kStripTop = 6, kStripBottom = 36;

/// Returns the sampling unit on which the verdict depends most. If the difference matters, this is the unit without
/// which the difference is smallest; otherwise it is the unit without which the difference is largest.
const LeftOut& Extreme(const Beyond& beyond, double practical) {
  const double all = *beyond.mean;
  const bool matters = std::abs(all) >= practical;
  return *std::ranges::min_element(beyond.left_out, {}, [&](const LeftOut& left) {
    return matters ? std::copysign(1.0, all) * left.difference : -std::abs(left.difference);
  });
}

std::string_view OneOf(SamplingUnit unit) {
  if (unit == SamplingUnit::kRecordedPerson) return "person";
  return unit == SamplingUnit::kLibrary ? "library" : "clip";
}

std::string Amount(double difference, const MetricWords& words) {
  return FormatNumber(difference * words.scale) + words.difference_suffix;
}

std::string WhatItDoes(const Beyond& beyond, const LeftOut& extreme, double practical, SamplingUnit unit) {
  const double all = *beyond.mean;
  const bool matters = std::abs(all) >= practical;
  const bool still = std::abs(extreme.difference) >= practical && (extreme.difference < 0) == (all < 0);
  if (matters && !still) return fmt::format("the difference depends on this {}", OneOf(unit));
  if (!matters && std::abs(extreme.difference) >= practical) {
    return fmt::format("without this {}, the difference would matter", OneOf(unit));
  }
  return fmt::format("no single {} decides whether the difference matters", OneOf(unit));
}

double PracticalOf(const Comparison& c) {
  const MetricInfo* info = FindMetric(c.metric);
  return info == nullptr ? 0 : info->practical;
}

}  // namespace

PairedDots PairedWorldsOf(const RunData& run, const ScenarioSummary& scenario, const Judged& judged) {
  const Comparison& c = *judged.comparison;
  const double scale = WordsFor(c.metric).scale;
  // Collect, for every world, the values of the metric under the two methods.
  std::map<int, Found> found;
  const KeptCells kept(run);
  for (const Row* row : RowsUnder(run, scenario.name, judged.condition->condition)) {
    if (row->method != c.baseline && row->method != c.method) continue;
    const auto value = ValueOf(*row, c.metric);
    if (!value || !std::isfinite(*value)) continue;
    Found& world = found[row->trial];
    world.row = row;
    const bool is_method = row->method == c.method;
    (is_method ? world.method : world.baseline) = scale * *value;
    (is_method ? world.method_cell : world.baseline_cell) = kept.Attribute(row->Id());
  }
  std::erase_if(found, [](const auto& entry) { return !entry.second.baseline || !entry.second.method; });

  // Keep every n-th world that has both values, with the world's sampling unit.
  PairedDots pairs;
  pairs.total = found.size();
  pairs.units = UnitNames(found);
  const std::size_t stride = StrideFor(found.size(), kMaxPlottedWorlds);
  std::size_t index = 0;
  for (const auto& [trial, world] : found) {
    if (index++ % stride != 0) continue;
    PairedWorld& pair = pairs.worlds.emplace_back();
    pair.trial = trial;
    pair.baseline = *world.baseline;
    pair.method = *world.method;
    pair.baseline_cell = world.baseline_cell;
    pair.method_cell = world.method_cell;
    if (world.row->units.empty()) continue;
    pair.unit =
        static_cast<std::size_t>(std::ranges::lower_bound(pairs.units, world.row->units.front()) - pairs.units.begin());
  }
  return pairs;
}

std::string EstimationHtml(const ScenarioSummary& scenario, const Judged& judged, const PairedDots& pairs) {
  if (pairs.worlds.empty()) return "";
  const Comparison& c = *judged.comparison;
  const Plot plot(scenario, judged, pairs);
  return fmt::format(
      "<figure class=\"worlds\" data-s=\"{}\" data-c=\"{}\" data-a=\"{}\" data-b=\"{}\"><figcaption>{}</figcaption>"
      "<div class=\"panels\">{}{}</div></figure>",
      EscapeMarkup(scenario.name), EscapeMarkup(CompactLabel(judged.condition->condition)), EscapeMarkup(c.baseline),
      EscapeMarkup(c.method), EscapeMarkup(Caption(judged, pairs)), plot.Values(), plot.Differences());
}

std::string EstimationLegend(const ScenarioSummary& scenario, const std::string& metric) {
  const MetricWords words = WordsFor(metric);
  const MetricInfo* info = FindMetric(metric);
  std::string text = fmt::format(
      "Left: the values of both methods, with one dot per world, coloured by {}. Right: the differences between the "
      "methods, with 95 % intervals",
      WorldsAreUnits(scenario.unit)              ? "method"
      : scenario.unit == SamplingUnit::kClipPair ? "the first clip of the transition"
                                                 : "the source of the world");
  if (info != nullptr) {
    text += fmt::format(". Shaded: differences of less than {:g}{}, which do not matter", info->practical * words.scale,
                        words.difference_suffix);
  }
  return text + ".";
}

std::string UnitLegendHtml(const PairedDots& pairs) {
  if (pairs.units.empty()) return "";
  std::string html = "<p class=\"quiet legend units\">";
  for (std::size_t i = 0; i < std::min(kMaxNamed, pairs.units.size()); ++i) {
    html += fmt::format("<span>{}{}</span> ", MarkKeySvg(0, i), EscapeMarkup(pairs.units[i]));
  }
  if (pairs.units.size() > kMaxNamed) html += fmt::format("and {} more", pairs.units.size() - kMaxNamed);
  return html + "</p>";
}

std::string WithoutEachUnit(const Comparison& c, SamplingUnit unit) {
  const Beyond& beyond = c.beyond;
  if (beyond.left_out.empty() || !beyond.mean) return "";
  const MetricWords words = WordsFor(c.metric);
  const auto [low, high] = std::ranges::minmax_element(beyond.left_out, {}, &LeftOut::difference);
  const LeftOut& extreme = Extreme(beyond, PracticalOf(c));
  return fmt::format(
      "“{}” against “{}”: if each {} in turn is left out, the mean difference is from {} to {}. Without “{}”, the mean "
      "difference is {}: {}.",
      c.method, c.baseline, OneOf(unit), Amount(low->difference, words), Amount(high->difference, words), extreme.unit,
      Amount(extreme.difference, words), WhatItDoes(beyond, extreme, PracticalOf(c), unit));
}

std::string LeftOutStripHtml(const Comparison& c, SamplingUnit unit) {
  const std::string text = WithoutEachUnit(c, unit);
  if (text.empty()) return "";
  const MetricWords words = WordsFor(c.metric);
  const double practical = PracticalOf(c) * words.scale;
  std::vector<double> values{practical, -practical, *c.beyond.mean * words.scale};
  for (const LeftOut& left : c.beyond.left_out) values.push_back(left.difference * words.scale);
  Axis axis = AxisAroundZero(values);
  axis.from = 12, axis.to = kPanelRight;
  std::string svg =
      BeginPanel(kStripHeight, text) +
      fmt::format("<rect class=\"band\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\"/>", axis.At(-practical),
                  kStripTop, std::max(1.0, axis.At(practical) - axis.At(-practical)), kStripBottom - kStripTop) +
      HorizontalAxisGrid(axis, kStripTop, kStripBottom) +
      fmt::format("<path class=\"zero\" d=\"M{:.1f} {}V{}\"/>", axis.At(0), kStripTop, kStripBottom);
  const LeftOut& extreme = Extreme(c.beyond, PracticalOf(c));
  for (const LeftOut& left : c.beyond.left_out) {
    svg += fmt::format("<path class=\"left{}\" d=\"M{:.1f} {}V{}\"><title>{}</title></path>",
                       &left == &extreme ? " extreme" : "", axis.At(left.difference * words.scale), kStripTop + 6,
                       kStripBottom - 6,
                       EscapeMarkup(fmt::format("without {}: {}", left.unit, Amount(left.difference, words))));
  }
  svg += fmt::format("<circle class=\"estimate\" cx=\"{:.1f}\" cy=\"{}\" r=\"4.5\"/></svg>",
                     axis.At(*c.beyond.mean * words.scale), (kStripTop + kStripBottom) / 2);
  return fmt::format("<figure class=\"left-out\">{}<figcaption>{}</figcaption></figure>", svg, EscapeMarkup(text));
}

}  // namespace etude
