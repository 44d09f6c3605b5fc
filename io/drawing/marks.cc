#include "io/drawing/marks.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/drawing/escape.h"

namespace etude {
namespace {

// All shapes look about equally large. Filled shapes come first.
constexpr std::array<std::string_view, 8> kShapes = {
    "M-3.5 0a3.5 3.5 0 1 0 7 0a3.5 3.5 0 1 0-7 0z",
    "M0-4.6L4.6 0 0 4.6-4.6 0z",
    "M0-4.2L4.3 3.4H-4.3z",
    "M-3.2-3.2H3.2V3.2H-3.2z",
    "M0 4.2L4.3-3.4H-4.3z",
    "M-1.3-4H1.3V-1.3H4V1.3H1.3V4H-1.3V1.3H-4V-1.3H-1.3z",
    "M-4.4 0L-2.2-3.8H2.2L4.4 0 2.2 3.8H-2.2z",
    "M-3.8-1.9L-1.9-3.8 0-1.9 1.9-3.8 3.8-1.9 1.9 0 3.8 1.9 1.9 3.8 0 1.9-1.9 3.8-3.8 1.9-1.9 0z"};

std::string Variables(std::string_view PlotColour::*scheme) {
  std::string css = ":root{";
  for (std::size_t i = 0; i < kPlotColours.size(); ++i) css += fmt::format("--m{}:{};", i, kPlotColours[i].*scheme);
  return css + "}";
}

constexpr double kMarkSize = 5;

}  // namespace

std::string MarksCss() {
  std::string css =
      Variables(&PlotColour::light) + "@media (prefers-color-scheme:dark){" + Variables(&PlotColour::dark) + "}";
  // Print with the light colours, whatever the screen shows.
  css += "@media print{" + Variables(&PlotColour::light) + "}";
  for (std::size_t i = 0; i < kPlotColours.size(); ++i) css += fmt::format(".f{0}{{fill:var(--m{0})}}", i);
  return css;
}

std::string MarkDefsSvg() {
  std::string svg = "<svg width=\"0\" height=\"0\" class=\"defs\" aria-hidden=\"true\"><defs>";
  for (std::size_t i = 0; i < kShapes.size(); ++i) svg += fmt::format("<path id=\"k{}\" d=\"{}\"/>", i, kShapes[i]);
  return svg + "</defs></svg>";
}

std::string MarkUse(std::size_t shape, std::size_t colour, double x, double y, std::string_view rest,
                    std::string_view title) {
  const std::string head = fmt::format("<use href=\"#k{}\" class=\"f{}\" x=\"{:.1f}\" y=\"{:.1f}\"{}",
                                       shape % kShapes.size(), colour % kPlotColours.size(), x, y, rest);
  return title.empty() ? head + "/>" : fmt::format("{}><title>{}</title></use>", head, EscapeMarkup(title));
}

std::string_view MarkDashes(std::size_t method) {
  // Dashes distinguish methods for readers who cannot distinguish the colours.
  constexpr std::array<std::string_view, 4> kDashes{"", "", " stroke-dasharray=\"6 4\"", " stroke-dasharray=\"2 3\""};
  return method < 8 ? kDashes[method / 2] : " stroke-dasharray=\"10 3 2 3\"";
}

std::string MethodLine(std::size_t method, std::string_view path) {
  return fmt::format("<path class=\"line\" style=\"stroke:var(--m{})\"{} d=\"{}\"/>", method % kPlotColours.size(),
                     MarkDashes(method), path);
}

std::string LineKeySvg(std::size_t method) {
  return fmt::format("<svg class=\"linekey\" viewBox=\"0 0 28 10\" aria-hidden=\"true\">{}</svg>",
                     MethodLine(method, "M1 5H27"));
}

std::string MarkKeySvg(std::size_t shape, std::size_t colour) {
  return "<svg class=\"key\" viewBox=\"-6 -6 12 12\" aria-hidden=\"true\">" + MarkUse(shape, colour, 0, 0) + "</svg>";
}

std::vector<double> SwarmOffsets(const std::vector<double>& positions, double max_offset) {
  std::map<long, std::vector<std::size_t>> bins;
  for (std::size_t i = 0; i < positions.size(); ++i) bins[std::lround(positions[i] / kMarkSize)].push_back(i);
  std::vector<double> offsets(positions.size(), 0);
  for (const auto& [bin, members] : bins) {
    // The first mark of a bin stays in the middle, and the other marks go alternately to either side; the step is
    // smaller in a crowded bin.
    const double sides = std::max<double>(1, static_cast<double>(members.size() / 2));
    const double step = std::min(kMarkSize, max_offset / sides);
    for (std::size_t k = 0; k < members.size(); ++k) {
      const double rank = static_cast<double>((k + 1) / 2);
      offsets[members[k]] = (k % 2 == 0 ? -1 : 1) * rank * step;
    }
  }
  return offsets;
}

std::size_t StrideFor(std::size_t count, std::size_t max_shown) {
  return std::max<std::size_t>(1, (count + max_shown - 1) / max_shown);
}

}  // namespace etude
