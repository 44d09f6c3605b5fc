#pragma once

#include <string_view>

namespace etude {

/// The parts of the page that are the same in every report, built into the program (CMakeLists.txt).
std::string_view ChartJs();
std::string_view ReportCss();
std::string_view ReportJs();

}  // namespace etude
