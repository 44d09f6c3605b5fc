#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/cameras/triangulation.h"

namespace etude {

struct WeightedSighting {
  Sighting sighting;
  double weight = 1;  ///< how sure it is; at most 0: passed over
};

struct RobustOptions {
  /// A sighting further than this from where the point is shown is wrong. Several times what the detector errs: at 20
  /// pixels, 60.
  double outlier_px = 60;
};

struct RobustPoint {
  glm::dvec3 position{0};      ///< p_WQ, metres
  std::vector<bool> agrees{};  ///< of each sighting
  double residual_px = 0;      ///< weighted root mean square over those that agree
};

/// The point that sightings agree on, where some of them may show something else *(ours)*: that of the views which
/// agree with each other (`AgreeingViews`, the surer ones counting more), of least Σ w · d², d being the distance in
/// the picture (`TriangulateLikeliest`); views that come within `outlier_px` of it, or leave that, are taken in or left
/// out, three times at most. Nothing when no two agree. Of two sightings, both must.
std::optional<RobustPoint> TriangulateRobustly(std::span<const WeightedSighting> sightings,
                                               const RobustOptions& options = {});

}  // namespace etude
