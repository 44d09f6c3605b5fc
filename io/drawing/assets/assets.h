#pragma once

#include <string_view>

namespace etude {

/// Return the parts of the page that every report shares; they are built into the program (CMakeLists.txt).
std::string_view ChartJs();
std::string_view ReportCss();
std::string_view ReportJs();
/// Returns the style and script of pages that show motions (reports/viewer).
std::string_view ViewerCss();
std::string_view ViewerJs();
/// Returns the style of pages that show figures of the papers, growth curves, or other curves.
std::string_view PaperCss();
/// Returns the styles of pages that reports/transitions makes.
std::string_view TransitionsCss();

}  // namespace etude
