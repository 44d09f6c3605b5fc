#include "reports/plots/left_out_strip.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "reports/plots/panel.h"
#include "reports/words/escape.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

constexpr double kStripHeight = 58, kStripTop = 6, kStripBottom = 36;

/// The unit that matters most: of a difference that matters the one without which least of it is left, else the one
/// without which most would be there.
const LeftOut& Extreme(const Beyond& beyond, double practical) {
  const double all = *beyond.difference;
  const bool matters = std::abs(all) >= practical;
  return *std::ranges::min_element(beyond.left_out, {}, [&](const LeftOut& left) {
    return matters ? std::copysign(1.0, all) * left.difference : -std::abs(left.difference);
  });
}

std::string_view OneOf(SamplingUnit unit) { return unit == SamplingUnit::kLibrary ? "library" : "clip"; }

std::string Amount(double difference, const MetricWords& words) {
  return FormatNumber(difference * words.scale) + words.difference_suffix;
}

std::string WhatItDoes(const Beyond& beyond, const LeftOut& extreme, double practical, SamplingUnit unit) {
  const double all = *beyond.difference;
  const bool matters = std::abs(all) >= practical;
  const bool still = std::abs(extreme.difference) >= practical && (extreme.difference < 0) == (all < 0);
  if (matters && !still) return fmt::format("then it no longer matters: this {} carries it", OneOf(unit));
  if (!matters && std::abs(extreme.difference) >= practical) {
    return fmt::format("then it would matter: this {} hides it", OneOf(unit));
  }
  return fmt::format("no single {} carries it", OneOf(unit));
}

double PracticalOf(const Comparison& c) {
  const MetricInfo* info = FindMetric(c.metric);
  return info == nullptr ? 0 : info->practical;
}

}  // namespace

std::string WithoutEachUnit(const Comparison& c, SamplingUnit unit) {
  const Beyond& beyond = c.beyond;
  if (beyond.left_out.empty() || !beyond.difference) return "";
  const MetricWords words = WordsFor(c.metric);
  const auto [low, high] = std::ranges::minmax_element(beyond.left_out, {}, &LeftOut::difference);
  const LeftOut& extreme = Extreme(beyond, PracticalOf(c));
  return fmt::format("“{}” against “{}”, mean difference without each {}: {} to {}. Without “{}” {}: {}.", c.method,
                     c.baseline, OneOf(unit), Amount(low->difference, words), Amount(high->difference, words),
                     extreme.unit, Amount(extreme.difference, words),
                     WhatItDoes(beyond, extreme, PracticalOf(c), unit));
}

std::string LeftOutStripHtml(const Comparison& c, SamplingUnit unit) {
  const std::string text = WithoutEachUnit(c, unit);
  if (text.empty()) return "";
  const MetricWords words = WordsFor(c.metric);
  const double practical = PracticalOf(c) * words.scale;
  std::vector<double> values{practical, -practical, *c.beyond.difference * words.scale};
  for (const LeftOut& left : c.beyond.left_out) values.push_back(left.difference * words.scale);
  Axis axis = AxisAroundZero(values);
  axis.from = 12, axis.to = kPanelRight;
  std::string svg = BeginPanel(kStripHeight, text) +
                    fmt::format("<rect class=\"band\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\"/>",
                                axis.At(-practical), kStripTop, std::max(1.0, axis.At(practical) - axis.At(-practical)),
                                kStripBottom - kStripTop) +
                    LyingGrid(axis, kStripTop, kStripBottom) +
                    fmt::format("<path class=\"zero\" d=\"M{:.1f} {}V{}\"/>", axis.At(0), kStripTop, kStripBottom);
  const LeftOut& extreme = Extreme(c.beyond, PracticalOf(c));
  for (const LeftOut& left : c.beyond.left_out) {
    svg += fmt::format("<path class=\"left{}\" d=\"M{:.1f} {}V{}\"><title>{}</title></path>",
                       &left == &extreme ? " extreme" : "", axis.At(left.difference * words.scale), kStripTop + 6,
                       kStripBottom - 6, EscapeMarkup(fmt::format("without {}: {}", left.unit, Amount(left.difference, words))));
  }
  svg += fmt::format("<circle class=\"estimate\" cx=\"{:.1f}\" cy=\"{}\" r=\"4.5\"/></svg>",
                     axis.At(*c.beyond.difference * words.scale), (kStripTop + kStripBottom) / 2);
  return fmt::format("<figure class=\"left-out\">{}<figcaption>{}</figcaption></figure>", svg, EscapeMarkup(text));
}

}  // namespace etude
