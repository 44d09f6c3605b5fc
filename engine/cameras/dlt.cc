#include "engine/cameras/dlt.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/named.h"

namespace etude {
namespace {

constexpr Named<Calibration> kCalibrations[] = {
    {"dlt", Calibration::kDlt}, {"dlt-normalised", Calibration::kDltNormalised}, {"refined", Calibration::kRefined}};

using Matrix34 = Eigen::Matrix<double, 3, 4>;

// A cloud of points counts as flat if its smallest extent is below this share of its largest extent. Measurement errors
// would then exceed the smallest extent, on which some entries of H depend.
constexpr double kFlat = 1e-4;
// Below this ratio of singular values (of the normalised system), another H fits the pairs equally well.
constexpr double kUndetermined = 1e-9;

Eigen::Vector3d ToEigen(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// Returns the reason why the pairs cannot determine a camera; nullopt if no reason is found.
std::optional<std::string> ReasonToRefuse(std::span<const PointPair> pairs) {
  constexpr std::size_t kMinPairs = 6;
  if (pairs.size() < kMinPairs) return fmt::format("found {} point pairs; allowed: at least 6", pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const PointPair& p = pairs[i];
    const double sum = p.world.x + p.world.y + p.world.z + p.pixel.x + p.pixel.y;
    if (!std::isfinite(sum)) return fmt::format("point pair {} has a coordinate that is not finite", i + 1);
  }
  // Compute the extents of the world points by principal components.
  Eigen::MatrixXd cloud(pairs.size(), 3);
  for (std::size_t i = 0; i < pairs.size(); ++i) cloud.row(i) = ToEigen(pairs[i].world).transpose();
  cloud.rowwise() -= cloud.colwise().mean().eval();
  const Eigen::Vector3d extents = Eigen::JacobiSVD<Eigen::MatrixXd>(cloud).singularValues();
  if (!(extents[1] > kFlat * extents[0])) return "the world points lie on one line; allowed: points that fill a volume";
  if (!(extents[2] > kFlat * extents[0]))
    return "the world points lie in one plane; allowed: points that fill a volume";
  return std::nullopt;
}

// A shift and scale, p' = scale · (p − mean), that moves the mean of the points to the origin and makes the points'
// mean distance from the origin √N (Hartley 1997).
template <int N>
struct Normalisation {
  Eigen::Matrix<double, N, 1> mean = Eigen::Matrix<double, N, 1>::Zero();
  double scale = 1;

  Eigen::Matrix<double, N, 1> Apply(const Eigen::Matrix<double, N, 1>& p) const { return scale * (p - mean); }
  Eigen::Matrix<double, N + 1, N + 1> Matrix() const {
    Eigen::Matrix<double, N + 1, N + 1> m = Eigen::Matrix<double, N + 1, N + 1>::Identity();
    m.template topLeftCorner<N, N>() *= scale;
    m.template topRightCorner<N, 1>() = -scale * mean;
    return m;
  }
};

template <int N, typename PointAt>
Normalisation<N> NormalisationOf(std::size_t count, PointAt point_at) {
  Normalisation<N> normalisation;
  for (std::size_t i = 0; i < count; ++i) normalisation.mean += point_at(i) / static_cast<double>(count);
  double distance = 0;
  for (std::size_t i = 0; i < count; ++i) {
    distance += (point_at(i) - normalisation.mean).norm() / static_cast<double>(count);
  }
  if (distance > 0) normalisation.scale = std::sqrt(static_cast<double>(N)) / distance;
  return normalisation;
}

struct Solution {
  Matrix34 H;
  double determined;  // ratio of the second smallest to the largest singular value
};

// Solves the two equations of each pair (2.4 and 2.5 of the paper, here for the entries of H) for |H| = 1: H is the
// right singular vector of the smallest singular value.
Solution SolveDlt(std::span<const PointPair> pairs, const Normalisation<3>& world, const Normalisation<2>& pixel) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * pairs.size(), 12);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Vector4d X = world.Apply(ToEigen(pairs[i].world)).homogeneous();
    const Eigen::Vector2d x = pixel.Apply({pairs[i].pixel.x, pairs[i].pixel.y});
    A.row(2 * i).segment<4>(0) = X;
    A.row(2 * i).segment<4>(8) = -x[0] * X;
    A.row(2 * i + 1).segment<4>(4) = X;
    A.row(2 * i + 1).segment<4>(8) = -x[1] * X;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullV);
  const Eigen::VectorXd h = svd.matrixV().col(11);
  Solution solution;
  for (int row = 0; row < 3; ++row) solution.H.row(row) = h.segment<4>(4 * row).transpose();
  solution.determined = svd.singularValues()[10] / svd.singularValues()[0];
  return solution;
}

}  // namespace

std::vector<std::string> CalibrationNames() { return NamesOf(kCalibrations); }

Calibration CalibrationNamed(std::string_view name) { return ValueNamed(kCalibrations, name); }

Result<ProjectionMatrix> Calibrate(std::span<const PointPair> pairs, Calibration calibration) {
  if (const auto reason = ReasonToRefuse(pairs)) return Fail({}, "cannot calibrate a camera: {}", *reason);

  const auto world = NormalisationOf<3>(pairs.size(), [&](std::size_t i) { return ToEigen(pairs[i].world); });
  const auto pixel = NormalisationOf<2>(
      pairs.size(), [&](std::size_t i) { return Eigen::Vector2d(pairs[i].pixel.x, pairs[i].pixel.y); });
  // For the plain and for the normalised method, test with the normalised system whether the pairs determine a camera.
  // The singular values of the plain system have no meaning, because that system mixes metres with squared pixels.
  const Solution normalised = SolveDlt(pairs, world, pixel);
  if (!(normalised.determined > kUndetermined)) {
    return Fail({},
                "cannot calibrate a camera: several different cameras fit these point pairs; measure some points at "
                "other positions");
  }
  const Matrix34 H = calibration == Calibration::kDlt
                         ? SolveDlt(pairs, {}, {}).H
                         : Matrix34(pixel.Matrix().inverse() * normalised.H * world.Matrix());

  // Scale H so that w is the depth, positive for the first point.
  double scale = H.row(2).head<3>().norm();
  const double w = H.row(2) * ToEigen(pairs[0].world).homogeneous();
  if (w < 0) scale = -scale;
  ProjectionMatrix matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) matrix.h[row][column] = H(row, column) / scale;
  }
  if (!std::isfinite(ReprojectionRms(matrix, pairs))) {
    return Fail({},
                "cannot calibrate a camera: no camera fits these point pairs, because some points would be behind the "
                "camera; are the world points paired with the right pixels?");
  }
  return matrix;
}

double ReprojectionRms(const ProjectionMatrix& matrix, std::span<const PointPair> pairs) {
  double squares = 0;
  for (const PointPair& pair : pairs) {
    const auto pixel = Project(matrix, pair.world);
    if (!pixel) return std::numeric_limits<double>::infinity();
    squares += glm::dot(*pixel - pair.pixel, *pixel - pair.pixel);
  }
  return pairs.empty() ? 0 : std::sqrt(squares / static_cast<double>(pairs.size()));
}

}  // namespace etude
