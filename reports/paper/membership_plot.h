#pragma once

#include <string>

#include "engine/fuzzy/membership.h"

namespace etude {

/// The membership functions of one feature over its universe as an SVG element of the page: drawn from GradeOf, each
/// term named at its peak, the axis marked where a straight-sided function bends.
std::string MembershipPlotSvg(Feature feature, const Memberships& memberships, const std::string& title);

}  // namespace etude
