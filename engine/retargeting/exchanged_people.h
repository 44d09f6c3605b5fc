#pragma once

#include <string>

#include "engine/formats/trc.h"
#include "engine/retargeting/marker_sets.h"

namespace etude {

/// Returns a message for the user about markers of one name that two people exchange from one frame to the next
/// (FindExchangesOf); "" if there are none. `one` and `other` are the columns of the two people in `markers`.
std::string DescribeExchangedMarkers(const MarkerMotion& markers, const MarkerColumns& one, const MarkerColumns& other);

}  // namespace etude
