#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/formats/trc.h"

namespace etude {

/// Tells whether a text begins as a take does that OptiTrack's Motive exported: with "Format Version,".
bool IsMotiveCsv(std::string_view text);

/// Reads such a take (versions 1.2x): the places of its bones, called as there ("Ann:LUArm"), or of its markers where
/// it has no bones. Metres, Y up; what was not seen stays empty. Refused, with the line: places that are not global,
/// other units than metres, centimetres, millimetres, no table, words for numbers, over 1,000 columns of either or 64
/// MiB.
Result<MarkerMotion> ReadMotiveCsv(std::string_view text, const std::string& file);

}  // namespace etude
