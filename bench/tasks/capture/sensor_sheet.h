#pragma once

#include "bench/model/sensor_sheet.h"
#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/stages.h"

namespace etude {

/// Two cameras at the take's liveliest frame: as the scenario has them, with labels, depth and the annotator's marks;
/// then every effect of a camera at three strengths, whatever else the scenario has left as it is. The true skeleton at
/// that time is drawn over what clocks and shutters do. Fails when there is no renderer.
Result<SensorSheet> MakeCaptureSheet(const StudioOptions& options, const WorldKey& key, CaptureStages& stages);

}  // namespace etude
