#pragma once

#include <vector>

#include "bench/keys/field_table.h"
#include "bench/tasks/capture/options.h"

namespace etude {

/// The keys of what the cameras do to the light: one per effect of CameraEffects, in their order.
std::vector<Field<StudioOptions>> CameraFields();

}  // namespace etude
