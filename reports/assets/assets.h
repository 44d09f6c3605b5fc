#pragma once

#include <string_view>

namespace etude {

/// The parts of the page that are the same in every report, built into the program (CMakeLists.txt).
std::string_view ChartJs();
std::string_view ReportCss();
std::string_view ReportJs();
/// Only for pages that show what paper_b_section.h makes.
std::string_view PaperCss();
/// Only for pages that show what reports/transitions makes.
std::string_view TransitionsCss();

}  // namespace etude
