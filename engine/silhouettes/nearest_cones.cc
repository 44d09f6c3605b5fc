// This file is compiled once for every vector instruction set of x86-64 CPUs; the best version is chosen at run time.
// All versions compute identical bits, because MulAdd is never used.
#include "engine/silhouettes/nearest_cones.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/silhouettes/nearest_cones.cc"
#include "hwy/foreach_target.h"  // must come before highway.h

// This header must be included after foreach_target.h.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Real = hn::CappedTag<double, kBlockPoints>;
using Vec = hn::Vec<Real>;

/// Cones in SIMD lanes: a different cone in every lane, or one cone in all lanes.
struct Cone {
  Vec rows[kConeRows];
};

/// Returns the signed distances of points to cones, lane by lane. The nearest point on the axis minimises the distance
/// minus the radius (`NearestOnCone`).
HWY_INLINE Vec SignedDistance(const Cone& cone, Vec u, Vec v) {
  const Real real;
  const Vec* const c = cone.rows;
  const auto from_u = hn::Sub(u, c[kEndU]), from_v = hn::Sub(v, c[kEndV]);
  const auto x = hn::Add(hn::Mul(from_u, c[kAxisU]), hn::Mul(from_v, c[kAxisV]));
  const auto y = hn::Abs(hn::Sub(hn::Mul(from_u, c[kAxisV]), hn::Mul(from_v, c[kAxisU])));
  const auto share = hn::Div(hn::Add(x, hn::Div(hn::Mul(y, c[kWidens]), c[kSlant])), c[kLength2]);
  const auto within = hn::Min(hn::Max(share, hn::Zero(real)), hn::Set(real, 1.0));
  const auto along = hn::IfThenElse(hn::Ge(c[kOnlyEnd], hn::Zero(real)), c[kOnlyEnd], within);
  const auto off_u = hn::Sub(from_u, hn::Mul(along, c[kAxisU])), off_v = hn::Sub(from_v, hn::Mul(along, c[kAxisV]));
  const auto distance = hn::Sqrt(hn::Add(hn::Mul(off_u, off_u), hn::Mul(off_v, off_v)));
  return hn::Sub(distance, hn::Add(c[kRadius], hn::Mul(along, c[kWidens])));
}

HWY_INLINE Cone ConesFrom(const ConeColumns& cones, size_t first) {
  Cone some;
  for (size_t row = 0; row < kConeRows; ++row) some.rows[row] = hn::LoadU(Real(), &cones.rows[row][first]);
  return some;
}

HWY_INLINE Cone ConeInAllLanes(const ConeColumns& cones, size_t i) {
  Cone same;
  for (size_t row = 0; row < kConeRows; ++row) same.rows[row] = hn::Set(Real(), cones.rows[row][i]);
  return same;
}

void FindNearest(const ConeColumns& cones, const PointColumns& points, double* distance, double* owner) {
  constexpr double kRounding = 1e-6;  // pixels; far above the rounding error of a distance
  const Real real;
  const size_t lanes = hn::Lanes(real);
  double near[kMaxCones];
  for (size_t block = 0; block < points.blocks; ++block) {
    const size_t first_point = block * kBlockPoints;
    // Compute the distances of all cones from the block's centre.
    const auto centre_u = hn::Set(real, points.centre_u[block]), centre_v = hn::Set(real, points.centre_v[block]);
    double least = 1e300;
    for (size_t i = 0; i < cones.count; i += lanes) {
      hn::StoreU(SignedDistance(ConesFrom(cones, i), centre_u, centre_v), real, near + i);
    }
    for (size_t i = 0; i < cones.count; ++i) least = near[i] < least ? near[i] : least;
    // Compute the reach. A cone farther than this from the block's centre lowers the distance of no point in the block.
    double farthest = distance[first_point];
    for (size_t i = 1; i < kBlockPoints; ++i) {
      farthest = distance[first_point + i] > farthest ? distance[first_point + i] : farthest;
    }
    const double radius = points.radius[block], nearest_reach = least + 2 * radius, own_reach = farthest + radius;
    const double reach = (nearest_reach < own_reach ? nearest_reach : own_reach) + kRounding;
    // Compare the points with every cone within reach.
    for (size_t cone = 0; cone < cones.count; ++cone) {
      if (!(near[cone] <= reach)) continue;
      const Cone same = ConeInAllLanes(cones, cone);
      const auto number = hn::Set(real, static_cast<double>(cone));
      for (size_t i = first_point; i < first_point + kBlockPoints; i += lanes) {
        const auto best = hn::LoadU(real, distance + i);
        const auto found = SignedDistance(same, hn::LoadU(real, points.u + i), hn::LoadU(real, points.v + i));
        const auto is_nearer = hn::Lt(found, best);
        hn::StoreU(hn::IfThenElse(is_nearer, found, best), real, distance + i);
        hn::StoreU(hn::IfThenElse(is_nearer, number, hn::LoadU(real, owner + i)), real, owner + i);
      }
    }
  }
}

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace etude {

HWY_EXPORT(FindNearest);

void FindNearestCones(const ConeColumns& cones, const PointColumns& points, double* distance, double* owner) {
  HWY_DYNAMIC_DISPATCH(FindNearest)(cones, points, distance, owner);
}

}  // namespace etude
#endif
