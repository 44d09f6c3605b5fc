#pragma once

#include "bench/tasks/detection/options.h"
#include "sim/skeleton_sensor/skeleton_sensor.h"

namespace etude {

/// What stands between the sensor and a performer at the origin who moves for so many frames: nothing; a desk with a
/// closed front, 75 cm high, 80 cm before the performer; a chair a little to the side, 90 cm high; a second person who
/// sways 1.2 m before the performer, beside the line to the sensor (all ours).
Occluders MakeOccluders(OccluderKind kind, const SensorPlace& sensor, std::size_t frames);

}  // namespace etude
