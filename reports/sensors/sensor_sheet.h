#pragma once

#include <string>

#include "bench/model/sensor_sheet.h"
#include "engine/base/result.h"

namespace etude {

/// Draws the rows below each other, all pictures at one width. The bytes of a PNG file. Fails for a sheet that is
/// larger than any picture may be, or has nothing to show.
Result<std::string> DrawSensorSheet(const SensorSheet& sheet);

}  // namespace etude
