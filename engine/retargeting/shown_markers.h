#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine/formats/trc.h"
#include "engine/motion/raw_motion.h"
#include "engine/retargeting/marker_sets.h"
#include "engine/retargeting/skin_markers.h"

namespace etude {

/// Makes MarkerBody::shown. `scale` is the length of the file's unit in metres, `seen` holds the joints of every frame,
/// and `up` is the direction that becomes Y.
RawMotion AsShown(double scale, const MarkerMotion& markers, const MarkerSet& set, const MarkerColumns& columns,
                  const std::vector<JointPositions>& seen, const glm::dvec3& up);

}  // namespace etude
