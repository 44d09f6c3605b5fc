#pragma once

#include <string>
#include <string_view>

#include "reports/plots/axis.h"

namespace etude {

/// Every panel is as wide as a telephone's screen, so that its text stays readable there.
inline constexpr double kPanelWidth = 340;
inline constexpr double kPanelLeft = 48, kPanelRight = 330;  ///< between which things are drawn

/// The head of a panel of this height, with what it shows in words.
std::string BeginPanel(double height, std::string_view words, std::string_view rest = "");

/// Lines and numbers of a value axis at the left, over the panel's width.
std::string UprightGrid(const Axis& axis);
/// The same of one that lies: between `top` and `bottom`, its numbers beneath.
std::string LyingGrid(const Axis& axis, double top, double bottom);

/// A text in the panel, escaped, cut after so many characters. `anchor`: "start", "middle", "end".
std::string PanelText(double x, double y, std::string_view text, std::string_view anchor, std::size_t most = 60);

}  // namespace etude
