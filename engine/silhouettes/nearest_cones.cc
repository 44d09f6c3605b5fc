// This file is compiled once for every vector instruction set of x86-64 CPUs; the best version is chosen at run time.
// All versions compute identical bits, because MulAdd is never used.
#include "engine/silhouettes/nearest_cones.h"

#include <cstdint>

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
constexpr size_t kParts = (6 + hn::MaxLanes(Real()) - 1) / hn::MaxLanes(Real());  // vectors that hold six numbers
using Single = hn::CappedTag<float, kConeLanes>;

/// The axes of cones in single precision: end 0, the axis, 1 / squared length, and the larger radius plus a bound of
/// the rounding error.
enum AxisRow { kFromU, kFromV, kAlongU, kAlongV, kInverse, kWidest, kAxisRows };
struct Axes {
  HWY_ALIGN float rows[kAxisRows][kMaxCones];
};

/// One cone in all lanes.
struct Cone {
  Vec rows[kConeRows];
};

/// In each lane, the point on a cone's axis that is nearest to a given point: `along` is 0 at end 0 and 1 at end 1.
struct OnAxis {
  Vec along, distance, signed_distance;
};

/// Finds, for each point, the place on the axis at which distance minus radius is smallest (`NearestOnCone`).
HWY_INLINE OnAxis NearestOnAxis(const Cone& cone, Vec u, Vec v) {
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
  return {along, distance, hn::Sub(distance, hn::Add(c[kRadius], hn::Mul(along, c[kWidens])))};
}

HWY_INLINE Cone ConeInAllLanes(const ConeColumns& cones, size_t i) {
  Cone same;
  for (size_t row = 0; row < kConeRows; ++row) same.rows[row] = hn::Set(Real(), cones.rows[row][i]);
  return same;
}

Axes AxesOf(const ConeColumns& cones) {
  constexpr double kRounding = 0.1, kRoundingShare = 1e-5;  // in pixels; as a share of the coordinates
  Axes axes;
  for (size_t i = 0; i < cones.count; ++i) {
    const auto of = [&](ConeRow row) { return cones.rows[row][i]; };
    const auto size = [](double x) { return x < 0 ? -x : x; };
    const double u = of(kAxisU), v = of(kAxisV), square = u * u + v * v;
    const double extent = size(of(kEndU)) + size(of(kEndV)) + size(u) + size(v);
    const double widest = of(kRadius) + (of(kWidens) > 0 ? of(kWidens) : 0) + kRounding + kRoundingShare * extent;
    const double row[kAxisRows] = {of(kEndU), of(kEndV), u, v, square > 0 ? 1 / square : 0, widest};
    for (size_t k = 0; k < kAxisRows; ++k) axes.rows[k][i] = static_cast<float>(row[k]);
  }
  return axes;
}

/// Writes a lower bound of each cone's signed distance from the point (u, v): the distance from the cone's axis, minus
/// the larger radius, minus a margin above the rounding error of single precision. `axes` holds the cones' axes
/// (`AxesOf`). Returns the smallest bound.
float LowerBounds(const Axes& axes, size_t count, float u, float v, float* bounds) {
  const Single single;
  const auto zero = hn::Zero(single), one = hn::Set(single, 1.0F);
  auto least = hn::Set(single, 3e38F);
  for (size_t i = 0; i < count; i += hn::Lanes(single)) {
    const auto from_u = hn::Sub(hn::Set(single, u), hn::Load(single, &axes.rows[kFromU][i]));
    const auto from_v = hn::Sub(hn::Set(single, v), hn::Load(single, &axes.rows[kFromV][i]));
    const auto along_u = hn::Load(single, &axes.rows[kAlongU][i]), along_v = hn::Load(single, &axes.rows[kAlongV][i]);
    const auto dot = hn::Add(hn::Mul(from_u, along_u), hn::Mul(from_v, along_v));
    const auto share = hn::Min(hn::Max(hn::Mul(dot, hn::Load(single, &axes.rows[kInverse][i])), zero), one);
    const auto off_u = hn::Sub(from_u, hn::Mul(share, along_u)), off_v = hn::Sub(from_v, hn::Mul(share, along_v));
    const auto distance = hn::Sqrt(hn::Add(hn::Mul(off_u, off_u), hn::Mul(off_v, off_v)));
    const auto bound = hn::Sub(distance, hn::Load(single, &axes.rows[kWidest][i]));
    hn::Store(bound, single, bounds + i);
    least = hn::Min(least, bound);
  }
  return hn::GetLane(hn::MinOfLanes(single, least));
}

/// Returns a set of bits: bit i tells whether bounds[i] is at most `reach`.
std::uint64_t Within(const float* bounds, size_t count, float reach) {
  const Single single;
  std::uint64_t set = 0;
  for (size_t i = 0; i < count; i += hn::Lanes(single)) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(single, hn::Le(hn::Load(single, bounds + i), hn::Set(single, reach)), bits);
    set |= std::uint64_t{bits[0]} << i;
  }
  return set;
}

/// Returns the index of the first bit that is set, or 64. Uses a builtin: if this file, compiled for newer CPUs,
/// contained a function of the standard library, the linker could make code for older CPUs call it.
HWY_INLINE size_t FirstOf(std::uint64_t set) { return set == 0 ? 64 : static_cast<size_t>(__builtin_ctzll(set)); }

/// For each point of one block, stores the distance and index of `cone` if `cone` is nearer than the stored cone, or
/// equally near with a lower index.
void Compare(const ConeColumns& cones, size_t cone, const PointColumns& points, size_t first_point, double* distance,
             double* owner) {
  const Real real;
  const Cone same = ConeInAllLanes(cones, cone);
  const auto number = hn::Set(real, static_cast<double>(cone));
  for (size_t i = first_point; i < first_point + kBlockPoints; i += hn::Lanes(real)) {
    const auto best = hn::LoadU(real, distance + i), whose = hn::LoadU(real, owner + i);
    const auto found =
        NearestOnAxis(same, hn::LoadU(real, points.u + i), hn::LoadU(real, points.v + i)).signed_distance;
    const auto is_nearer = hn::Or(hn::Lt(found, best), hn::And(hn::Eq(found, best), hn::Lt(number, whose)));
    hn::StoreU(hn::IfThenElse(is_nearer, found, best), real, distance + i);
    hn::StoreU(hn::IfThenElse(is_nearer, number, whose), real, owner + i);
  }
}

/// Returns false if `cone` is certainly not nearer to any point of a block than the stored distance. Computes no
/// division and no root.
bool MayLower(const Axes& axes, size_t cone, const PointColumns& points, size_t first_point, const double* distance) {
  const Real real;
  const auto zero = hn::Zero(real), one = hn::Set(real, 1.0);
  Vec axis[kAxisRows];
  for (size_t row = 0; row < kAxisRows; ++row) axis[row] = hn::Set(real, static_cast<double>(axes.rows[row][cone]));
  for (size_t i = first_point; i < first_point + kBlockPoints; i += hn::Lanes(real)) {
    const auto from_u = hn::Sub(hn::LoadU(real, points.u + i), axis[kFromU]);
    const auto from_v = hn::Sub(hn::LoadU(real, points.v + i), axis[kFromV]);
    const auto dot = hn::Add(hn::Mul(from_u, axis[kAlongU]), hn::Mul(from_v, axis[kAlongV]));
    const auto share = hn::Min(hn::Max(hn::Mul(dot, axis[kInverse]), zero), one);
    const auto off_u = hn::Sub(from_u, hn::Mul(share, axis[kAlongU]));
    const auto off_v = hn::Sub(from_v, hn::Mul(share, axis[kAlongV]));
    const auto reach = hn::Max(hn::Add(hn::LoadU(real, distance + i), axis[kWidest]), zero);
    const auto square = hn::Add(hn::Mul(off_u, off_u), hn::Mul(off_v, off_v));
    if (!hn::AllFalse(real, hn::Lt(square, hn::Mul(reach, reach)))) return true;
  }
  return false;
}

/// Returns the largest of a block's distances.
double Farthest(const double* distance) {
  const Real real;
  auto most = hn::LoadU(real, distance);
  for (size_t i = hn::Lanes(real); i < kBlockPoints; i += hn::Lanes(real)) {
    most = hn::Max(most, hn::LoadU(real, distance + i));
  }
  return hn::GetLane(hn::MaxOfLanes(real, most));
}

void FindNearest(const ConeColumns& cones, const PointColumns& points, double* distance, double* owner) {
  const Axes axes = AxesOf(cones);
  HWY_ALIGN float bounds[kMaxCones];
  for (size_t block = 0; block < points.blocks; ++block) {
    const size_t first_point = block * kBlockPoints;
    const double radius = points.radius[block];
    const float least = LowerBounds(axes, cones.count, static_cast<float>(points.centre_u[block]),
                                    static_cast<float>(points.centre_v[block]), bounds);
    // Compare the points with the cone that is probably nearest. A cone cannot lower any point's distance if the cone's
    // bound exceeds the points' largest distance by more than the block's radius.
    if (!(least <= Farthest(distance + first_point) + radius)) continue;
    const auto nearest = FirstOf(Within(bounds, cones.count, least));
    if (nearest >= cones.count) continue;  // no cone is valid
    Compare(cones, nearest, points, first_point, distance, owner);
    // Compare the points with every other cone within reach.
    const double reach = Farthest(distance + first_point) + radius;
    std::uint64_t others = Within(bounds, cones.count, static_cast<float>(reach)) & ~(std::uint64_t{1} << nearest);
    for (; others != 0; others &= others - 1) {
      const size_t cone = FirstOf(others);
      if (!MayLower(axes, cone, points, first_point, distance)) continue;
      Compare(cones, cone, points, first_point, distance, owner);
    }
  }
}

/// The numbers of one point: its six derivatives, its weight, and the weight times the residual.
enum PointNumber { kWeight = 6, kWeightedValue, kNumbers };

/// Adds one point to the sums. Rows 0 to 5 belong to the six derivatives; rows 6 and 7 fill the vectors and are
/// ignored.
HWY_INLINE void AddPoint(const double* point, Vec (&gradient)[kParts], Vec (&hessian)[6][kParts]) {
  const Real real;
  for (size_t part = 0; part < kParts; ++part) {
    const auto rows = hn::Load(real, point + part * hn::Lanes(real));
    gradient[part] = hn::Add(gradient[part], hn::Mul(hn::Set(real, point[kWeightedValue]), rows));
    const auto weighted = hn::Mul(hn::Set(real, point[kWeight]), rows);
    for (size_t column = 0; column < 6; ++column) {
      hessian[column][part] = hn::Add(hessian[column][part], hn::Mul(weighted, hn::Set(real, point[column])));
    }
  }
}

void SumCone(const ConeColumns& cones, size_t cone, const ConePoints& points, ConeSums& sums) {
  const Real real;
  const Cone same = ConeInAllLanes(cones, cone);
  const Vec* const c = same.rows;
  const auto zero = hn::Zero(real), one = hn::Set(real, 1.0);
  Vec gradient[kParts], hessian[6][kParts];
  for (size_t part = 0; part < kParts; ++part) {
    gradient[part] = zero;
    for (size_t column = 0; column < 6; ++column) hessian[column][part] = zero;
  }
  HWY_ALIGN double numbers[kNumbers][kBlockPoints], transposed[kBlockPoints][kNumbers];
  for (size_t first = 0; first < points.count; first += kBlockPoints) {
    // Compute the derivatives and weights of eight points (`DistanceTo`, `LossOf`).
    for (size_t i = 0; i < kBlockPoints; i += hn::Lanes(real)) {
      const auto u = hn::LoadU(real, points.u + first + i), v = hn::LoadU(real, points.v + first + i);
      const OnAxis nearest = NearestOnAxis(same, u, v);
      const auto t = nearest.along, s = hn::Sub(one, t);
      const auto away_u = hn::Sub(u, hn::Add(hn::Mul(c[kEndU], s), hn::Mul(c[kOtherU], t)));
      const auto away_v = hn::Sub(v, hn::Add(hn::Mul(c[kEndV], s), hn::Mul(c[kOtherV], t)));
      const auto is_apart = hn::Gt(nearest.distance, zero);
      const auto normal_u = hn::IfThenElseZero(is_apart, hn::Div(away_u, nearest.distance));
      const auto normal_v = hn::IfThenElseZero(is_apart, hn::Div(away_v, nearest.distance));
      const auto value = nearest.signed_distance, square = hn::Mul(value, value);
      const auto share = hn::Div(one, hn::Add(one, hn::Div(square, hn::Set(real, points.reach2))));
      const auto weight = hn::Mul(hn::Mul(hn::Set(real, points.counts), share), share);
      const Vec rows[kNumbers] = {hn::Mul(hn::Neg(s), normal_u),
                                  hn::Mul(hn::Neg(s), normal_v),
                                  hn::Neg(s),
                                  hn::Mul(hn::Neg(t), normal_u),
                                  hn::Mul(hn::Neg(t), normal_v),
                                  hn::Neg(t),
                                  weight,
                                  hn::Mul(weight, value)};
      for (size_t k = 0; k < kNumbers; ++k) hn::Store(rows[k], real, &numbers[k][i]);
    }
    // Add them in the points' order, so that the sums do not depend on the vectors' width.
    const size_t count = points.count - first < kBlockPoints ? points.count - first : kBlockPoints;
    for (size_t i = 0; i < count; ++i) {
      for (size_t k = 0; k < kNumbers; ++k) transposed[i][k] = numbers[k][i];
    }
    for (size_t i = 0; i < count; ++i) AddPoint(transposed[i], gradient, hessian);
  }
  for (size_t part = 0; part < kParts; ++part) {
    const size_t row = part * hn::Lanes(real);
    hn::StoreU(gradient[part], real, sums.gradient + row);
    for (size_t column = 0; column < 6; ++column) hn::StoreU(hessian[column][part], real, sums.hessian[column] + row);
  }
}

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace etude {

HWY_EXPORT(FindNearest);
HWY_EXPORT(SumCone);

void FindNearestCones(const ConeColumns& cones, const PointColumns& points, double* distance, double* owner) {
  HWY_DYNAMIC_DISPATCH(FindNearest)(cones, points, distance, owner);
}

void SumConePoints(const ConeColumns& cones, std::size_t cone, const ConePoints& points, ConeSums& sums) {
  HWY_DYNAMIC_DISPATCH(SumCone)(cones, cone, points, sums);
}

}  // namespace etude
#endif
