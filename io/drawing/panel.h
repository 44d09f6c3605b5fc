#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// A number axis of an SVG panel, in the panel's own units. Every picture of the page places values by one.
struct Axis {
  double low = 0, high = 1;
  bool is_logarithmic = false;
  double from = 0, to = 1;  ///< where `low` and `high` lie; `from` may be the larger one

  /// Gives the place of a value; one beyond an end lies on that end.
  double At(double value) const;
  /// Gives about five round values; of a logarithmic axis powers of ten. Never empty.
  std::vector<double> Ticks() const;
  /// Names a tick: "12", "−3", "0.01"; on a logarithmic axis "100k", "1e-3".
  std::string TickText(double value) const;
};

/// Makes an axis that holds all values. Where `floor` is above 0 and the values spread over more than two decades it is
/// logarithmic, and what lies below `floor` is drawn on its end. Without values it is 0…1.
Axis AxisOf(const std::vector<double>& values, double floor);

/// Makes a linear axis that holds all values and zero.
Axis AxisAroundZero(const std::vector<double>& values);

/// Makes a logarithmic axis of whole decades, one to eight of them, that ends above the largest value and holds the
/// others as far as it reaches. Without a value above zero it is 1…10.
Axis DecadeAxis(const std::vector<double>& values);

/// Names a number on a linear axis: "0.01", "12", "−3", "1e-05".
std::string TickText(double value);

/// Names a power of ten: "0.01", "100k", "1M", "1e-3".
std::string DecadeText(int decade);

/// The width of a panel is that of a telephone's screen, so that its text stays readable there.
inline constexpr double kPanelWidth = 340;
inline constexpr double kPanelLeft = 48, kPanelRight = 330;  ///< between which things are drawn

/// Opens a panel of this height, with what it shows in words. `style` is its class on the page: "plot", or "panel" for
/// the smaller ones of the papers.
std::string BeginPanel(double height, std::string_view words, double width = kPanelWidth,
                       std::string_view style = "plot");

/// Draws lines and numbers of a value axis at the left, over the width from `left` to `right`.
std::string UprightGrid(const Axis& axis, double left = kPanelLeft, double right = kPanelRight);
/// Draws those of an axis that lies: lines between `top` and `bottom`, numbers beneath.
std::string LyingGrid(const Axis& axis, double top, double bottom);

/// Writes a text in the panel, escaped, cut after `most` characters. `anchor`: "start", "middle", "end".
std::string PanelText(double x, double y, std::string_view text, std::string_view anchor, std::size_t most = 60);

}  // namespace etude
