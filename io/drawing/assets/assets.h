#pragma once

#include <string_view>

namespace etude {

/// Return the scripts and styles that every report's page uses. They are built into the program (CMakeLists.txt).
std::string_view ReportCss();
std::string_view ReportJs();
/// Returns the style and script of pages that show motions (reports/viewer).
std::string_view ViewerCss();
std::string_view ViewerJs();
/// Returns the script of the page on which people compare films.
std::string_view BlindJs();
/// Returns the styles of pages for papers and of pages with growth curves.
std::string_view PaperCss();
/// Returns the styles of pages that reports/transitions makes.
std::string_view TransitionsCss();

}  // namespace etude
