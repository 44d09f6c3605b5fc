#pragma once

#include <string_view>

namespace etude {

/// The parts of the page that are the same in every report, built into the program (CMakeLists.txt).
std::string_view ChartJs();
std::string_view ReportCss();
std::string_view ReportJs();
/// Gives styles and script of pages that show motions (reports/viewer).
std::string_view ViewerCss();
std::string_view ViewerJs();
/// Gives the styles of pages that show curves of the papers or of growth.
std::string_view PaperCss();
/// Gives the styles of pages that show what reports/transitions makes.
std::string_view TransitionsCss();

}  // namespace etude
