#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// A colour for light pages and a colour for dark pages, "#rrggbb". Films use `dark`.
struct PlotColour {
  std::string_view light, dark;
};

/// The colours of methods by the methods' index in the scenario; the colours repeat after eight methods. People with
/// protanopia, deuteranopia or tritanopia can distinguish the colours, and the colours differ from both backgrounds
/// (marks_test.cc).
inline constexpr std::array<PlotColour, 8> kPlotColours = {{{"#41464b", "#969ca1"},
                                                            {"#1ea194", "#9ff5d4"},
                                                            {"#9c5201", "#f97341"},
                                                            {"#8b19e6", "#d065fe"},
                                                            {"#316f93", "#3c80b4"},
                                                            {"#ae8f16", "#e3c662"},
                                                            {"#470014", "#b35e52"},
                                                            {"#02175b", "#a8c4d6"}}};

/// Returns the CSS variables --m0 … --m7 for the light and the dark colour scheme.
std::string MarksCss();

/// Returns the SVG shapes that MarkUse refers to; a page must contain these shapes once.
std::string MarkDefsSvg();

/// Draws a mark at (`x`, `y`) as an SVG element: the shape of method `shape` in the colour of method `colour`. `rest`
/// holds further attributes.
std::string MarkUse(std::size_t shape, std::size_t colour, double x, double y, std::string_view rest = "",
                    std::string_view title = "");

/// Returns the dash attribute of a method's line, with a leading space, or "".
std::string_view MarkDashes(std::size_t method);

/// Draws a method's line along an SVG path.
std::string MethodLine(std::size_t method, std::string_view path);

/// Draws the short line that stands for a method in a legend.
std::string LineKeySvg(std::size_t method);

/// Draws a mark alone, for a legend.
std::string MarkKeySvg(std::size_t shape, std::size_t colour);

/// Computes a sideways offset for each mark of a row, so that neighbouring marks can be distinguished. `positions` are
/// along the row, in the panel's units; offsets are at most `max_offset` to either side. The same positions give the
/// same offsets.
std::vector<double> SwarmOffsets(const std::vector<double>& positions, double max_offset);

/// Returns the stride at which `count` marks are drawn, so that at most `max_shown` marks are drawn.
std::size_t StrideFor(std::size_t count, std::size_t max_shown);

}  // namespace etude
