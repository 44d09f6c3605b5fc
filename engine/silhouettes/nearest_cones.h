#pragma once

#include <cstddef>

namespace etude {

inline constexpr std::size_t kConeLanes = 8, kMaxCones = 64, kBlockPoints = 8;

/// The numbers of a projected capsule, pixels: one end, the axis from there to the other end, its squared length, the
/// radius of the other end minus that of this end, √(length² − that²), the radius of this end, and the end (0 or 1)
/// whose circle contains the other's, or −1.
enum ConeRow { kEndU, kEndV, kAxisU, kAxisV, kLength2, kWidens, kSlant, kRadius, kOnlyEnd, kConeRows };

/// Projected capsules, one per column; `count` is a multiple of kConeLanes. Columns beyond the last capsule, and those
/// of invalid capsules, hold a cone at infinite distance.
struct ConeColumns {
  std::size_t count = 0;
  double rows[kConeRows][kMaxCones];
};

/// Points (u, v) in pixels, in blocks of kBlockPoints neighbours, with a circle around each block. The last block is
/// filled up by repeating its last point.
struct PointColumns {
  std::size_t blocks = 0;
  const double *u = nullptr, *v = nullptr;
  const double *centre_u = nullptr, *centre_v = nullptr, *radius = nullptr;
};

/// Lowers each point's `distance` (pixels) to its smallest signed distance to the cones, negative inside, if that is
/// less; then sets the point's `owner` to the index of the cone, the first of several at equal distance. Each block
/// tests only the cones that can be nearest to one of its points: if a point moves, its signed distance changes by at
/// most as much. Uses SIMD in double precision; with any vector width the bits are those of `NearestOnCone`
/// (silhouette_cost.cc).
void FindNearestCones(const ConeColumns& cones, const PointColumns& points, double* distance, double* owner);

}  // namespace etude
