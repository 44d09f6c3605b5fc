#pragma once

#include <cstddef>

namespace etude {

inline constexpr std::size_t kConeLanes = 8, kMaxCones = 64, kBlockPoints = 8;

/// The numbers of a projected capsule, pixels: end 0 (u, v), the axis from end 0 to end 1 (u, v), the axis's squared
/// length, the growth of the radius from end 0 to end 1, √(squared length − growth²), the radius of end 0, and end 1
/// (u, v). kOnlyEnd is the end whose circle contains the other end's circle, or −1.
enum ConeRow {
  kEndU,
  kEndV,
  kAxisU,
  kAxisV,
  kLength2,
  kWidens,
  kSlant,
  kRadius,
  kOnlyEnd,
  kOtherU,
  kOtherV,
  kConeRows
};

/// Projected capsules, one per column; `count` is a multiple of kConeLanes. Spare columns and columns of invalid
/// capsules hold a cone at infinite distance.
struct ConeColumns {
  std::size_t count = 0;
  double rows[kConeRows][kMaxCones];
};

/// Points (u, v) in pixels, in blocks of kBlockPoints neighbouring points, with a circle around each block. The last
/// block is filled up with copies of its last point.
struct PointColumns {
  std::size_t blocks = 0;
  const double *u = nullptr, *v = nullptr;
  const double *centre_u = nullptr, *centre_v = nullptr, *radius = nullptr;
};

/// For each point, finds the smallest signed distance to the cones, pixels, negative inside. If this distance is
/// smaller than the point's entry in `distance`, the distance replaces the entry, and the index of the cone (of equally
/// near cones, the lowest index) goes to `owner`. For each block, only cones that can be nearest to a point of the
/// block are tested. (The signed distances of two points to a cone differ by at most the distance between the points.)
/// Uses SIMD in double precision; with any vector width, the bits equal those of `NearestOnCone` (silhouette_cost.cc).
void FindNearestCones(const ConeColumns& cones, const PointColumns& points, double* distance, double* owner);

/// The outline points that are nearest to one cone. After the last point, kBlockPoints − 1 further numbers of u and v
/// must be readable.
struct ConePoints {
  std::size_t count = 0;
  const double *u = nullptr, *v = nullptr;
  double counts = 1, reach2 = 1;  ///< parameters of the loss (`LossOf`): 1 / sigma², and reach² (pixels²)
};
/// Sums over points, with r the residual's derivatives with respect to the cone's six numbers: Σ w e r, and Σ w r rᵀ by
/// columns. Rows 6 and 7 are not used.
struct ConeSums {
  double gradient[8] = {};
  double hessian[6][8] = {};
};
/// Computes these sums over the points, in the order of the points. The bits equal those of a loop that calls
/// `DistanceTo` and `LossOf` (silhouette_cost.h) for each point.
void SumConePoints(const ConeColumns& cones, std::size_t cone, const ConePoints& points, ConeSums& sums);

}  // namespace etude
