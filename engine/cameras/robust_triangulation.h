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

/// The point that sightings agree on, where some of them may show something else (ours). Every pair of them proposes
/// a point; the one for which Σ w · max(0, 1 − d²/τ²) is largest wins, d being the distance in the picture and τ
/// `outlier_px` (MSAC with all pairs: no dice). From those within τ of it the point follows by least squares of
/// √w · d, by Gauss–Newton. Nothing when no two agree. Of two sightings, both must.
std::optional<RobustPoint> TriangulateRobustly(std::span<const WeightedSighting> sightings,
                                               const RobustOptions& options = {});

}  // namespace etude
