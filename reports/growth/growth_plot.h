#pragma once

#include <string>
#include <vector>

#include "reports/growth/growth_curves.h"

namespace etude {

/// The curves as an SVG element, both axes logarithmic in whole decades; "" when no curve has a point.
std::string GrowthPlotSvg(const std::vector<GrowthCurve>& curves, const std::string& title);

}  // namespace etude
