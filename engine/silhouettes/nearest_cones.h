#pragma once

#include <cstddef>

namespace etude {

inline constexpr std::size_t kConeLanes = 8, kMaxCones = 64, kBlockPoints = 8;

/// The numbers of a projected capsule, pixels: one end, the axis from there to the other end, its squared length, the
/// radius of the other end minus that of this end, √(length² − that²), the radius of this end, and the end (0 or 1) whose
/// circle contains the other's, or −1.
enum ConeRow { kEndU, kEndV, kAxisU, kAxisV, kLength2, kWidens, kSlant, kRadius, kOnlyEnd, kConeRows };

/// Projected capsules, a column each; `count` is a multiple of kConeLanes. Columns beyond the last capsule, and those of
/// invalid ones, hold a cone that is infinitely far.
struct ConeColumns {
  std::size_t count = 0;
  double rows[kConeRows][kMaxCones];
};

/// Points as columns, in blocks of kBlockPoints neighbours, with a circle around each block; the last block is filled by
/// repeating its last point.
struct PointColumns {
  std::size_t blocks = 0;
  const double *u = nullptr, *v = nullptr;
  const double *centre_u = nullptr, *centre_v = nullptr, *radius = nullptr;
};

/// Lowers each point's `distance` to its smallest signed distance to the cones if that is less, and then sets `owner` to
/// the cone: the first of several at equal distance. Each block looks only at cones that can be nearest to one of its
/// points: a signed distance changes by no more than the point moves. By SIMD in double precision; any width gives the
/// bits of `NearestOnCone` (silhouette_cost.cc).
void FindNearestCones(const ConeColumns& cones, const PointColumns& points, double* distance, double* owner);

}  // namespace etude
