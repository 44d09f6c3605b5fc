#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// A numeric axis of an SVG panel. It maps values to positions in the panel's units.
struct Axis {
  double low = 0, high = 1;
  bool is_logarithmic = false;
  double from = 0, to = 1;  ///< the positions of `low` and `high`; `from` may exceed `to`
  std::string low_label = {};  ///< the label of `low`, which smaller values share; "" = the number

  /// Returns the position of a value; a value outside the axis gets the position of the nearer end.
  double At(double value) const;
  /// Returns about five round values, or powers of ten on a logarithmic axis. Never empty.
  std::vector<double> Ticks() const;
  /// Returns the label of a tick: "12", "−3", "0.01"; on a logarithmic axis "100k", "1e-3".
  std::string TickText(double value) const;
};

/// Makes an axis that holds all values. It is logarithmic if `floor` is above 0, no value is below 0, and the values
/// above 0, with those below `floor` raised to `floor`, span more than two decades. A logarithmic axis begins and ends
/// at whole powers of ten. Values above 0 that lie below its lower end are drawn there, and the end is labelled
/// "≤1e-3". If there are none, but a value is 0, the axis begins one decade lower, at the label "0". Without values,
/// the axis is 0…1.
Axis AxisOf(const std::vector<double>& values, double floor);

/// Makes a linear axis that holds all values and zero.
Axis AxisAroundZero(const std::vector<double>& values);

/// Makes a logarithmic axis of one to eight whole decades. The axis ends at or above the largest value. It begins at
/// or below the smallest positive value, but at most eight decades below the axis's end. Without a value above zero,
/// the axis is 1…10.
Axis DecadeAxis(const std::vector<double>& values);

/// Returns the label of a number on a linear axis: "0.01", "12", "−3", "1e-05".
std::string TickText(double value);

/// Returns the label of a power of ten: "0.01", "100k", "1M", "1e-3".
std::string DecadeText(int decade);

/// A panel is as wide as a telephone's screen, so that the panel's text is readable on a telephone.
inline constexpr double kPanelWidth = 340;
inline constexpr double kPanelLeft = 48, kPanelRight = 330;  ///< the left and right limits of the drawing area

/// Opens a panel of this height; `words` describe the panel to screen readers. `style` is the panel's CSS class:
/// "plot", or "panel" for the smaller panels of paper pages.
std::string BeginPanel(double height, std::string_view words, double width = kPanelWidth,
                       std::string_view style = "plot");

/// Draws the grid lines and labels of a vertical axis; lines go from `left` to `right`, labels stand left of the lines.
std::string VerticalAxisGrid(const Axis& axis, double left = kPanelLeft, double right = kPanelRight);
/// Draws the grid lines and labels of a horizontal axis; lines go from `top` to `bottom`, labels stand below.
std::string HorizontalAxisGrid(const Axis& axis, double top, double bottom);

/// Writes a text in the panel, escaped and cut after `max_characters`. `anchor` is "start", "middle" or "end".
std::string PanelText(double x, double y, std::string_view text, std::string_view anchor,
                      std::size_t max_characters = 60);

}  // namespace etude
