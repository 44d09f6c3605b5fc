#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/formats/trc.h"

namespace etude {

/// Returns true if a text begins like a take exported by OptiTrack's Motive: with "Format Version,".
bool IsMotiveCsv(std::string_view text);

/// Reads a take exported by Motive (versions 1.2x): the positions of its bones with their names in the file
/// ("Ann:LUArm"), or of its markers if it has no bones. Positions are in metres, Y up; a position that was not seen is
/// empty. The rows are placed on frames (`LayOnClock`) by the times in the column Time or, if it is empty, by the
/// numbers in the column Frame. Returns an error with the line if coordinates are not global, the unit is not metres,
/// centimetres, millimetres, inches or feet, there is no table, a cell is not a number, there are more than 1,000 bones
/// or markers, or the text exceeds 64 MiB; also returns the errors of GridOfRows.
Result<MarkerMotion> ReadMotiveCsv(std::string_view text, const std::string& file);

}  // namespace etude
