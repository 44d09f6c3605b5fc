#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// A colour on a light and on a dark page, "#rrggbb". Films are dark.
struct PlotColour {
  std::string_view light, dark;
};

/// The colours of methods, by their index in the scenario; after eight they begin again. They are told apart with
/// protanopia, deuteranopia and tritanopia, and from both backgrounds (marks_test.cc).
inline constexpr std::array<PlotColour, 8> kPlotColours = {{{"#41464b", "#969ca1"},
                                                            {"#1ea194", "#9ff5d4"},
                                                            {"#9c5201", "#f97341"},
                                                            {"#8b19e6", "#d065fe"},
                                                            {"#316f93", "#3c80b4"},
                                                            {"#ae8f16", "#e3c662"},
                                                            {"#470014", "#b35e52"},
                                                            {"#02175b", "#a8c4d6"}}};

/// Writes the page's variables --m0 … --m7 for both colour schemes.
std::string MarksCss();

/// Writes the marks' shapes, once per page: what MarkUse points to.
std::string MarkDefsSvg();

/// Draws a mark at a place as an SVG element: the shape of the method of index `shape` in the colour of index `colour`.
/// `rest` holds more attributes.
std::string MarkUse(std::size_t shape, std::size_t colour, double x, double y, std::string_view rest = "",
                    std::string_view title = "");

/// Gives a line's dashes, by its method: an attribute with a space before it, or "".
std::string_view MarkDashes(std::size_t method);

/// Draws a method's line along an SVG path.
std::string MethodLine(std::size_t method, std::string_view path);

/// Draws the short line that stands for a method in a legend.
std::string LineKeySvg(std::size_t method);

/// Draws a mark alone, for a legend.
std::string MarkKeySvg(std::size_t shape, std::size_t colour);

/// Computes how far each mark of a row is moved aside, so that marks at neighbouring places can be told apart: `places`
/// along the row, in the panel's units; at most `most` to either side. The same places give the same swarm.
std::vector<double> SwarmOffsets(const std::vector<double>& places, double most);

/// Gives the stride at which `count` marks are drawn, so that no more than `most` are.
std::size_t StrideFor(std::size_t count, std::size_t most);

}  // namespace etude
