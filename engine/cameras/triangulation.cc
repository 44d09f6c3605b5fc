#include "engine/cameras/triangulation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/cameras/limb_direction.h"

namespace etude {
namespace {

// Below this ratio of the smallest to the largest singular value, the rays meet at too small an angle: an error of one
// pixel would move the point by metres. Two cameras 1° apart give about 10⁻².
constexpr double kParallel = 1e-3;

double ResidualPx(std::span<const Sighting> sightings, const glm::dvec3& p_WQ) {
  double squares = 0;
  for (const Sighting& s : sightings) {
    const auto pixel = Project(s.matrix, p_WQ);
    if (!pixel) return -1;
    squares += glm::dot(*pixel - s.pixel, *pixel - s.pixel);
  }
  return std::sqrt(squares / static_cast<double>(sightings.size()));
}

// Returns the distance of a point from the camera's plane in the unit of the world; the distance does not depend on the
// scale of H.
double DepthOf(const ProjectionMatrix& matrix, const glm::dvec3& p_WQ) {
  const auto& h3 = matrix.h[2];
  const double scale = std::sqrt(h3[0] * h3[0] + h3[1] * h3[1] + h3[2] * h3[2]);
  return std::abs(h3[0] * p_WQ.x + h3[1] * p_WQ.y + h3[2] * p_WQ.z + h3[3]) / scale;
}

// Solves the linear equations by least squares (SVD), with each sighting's two rows multiplied by its weight.
TriangulatedPoint TriangulateWeighted(std::span<const Sighting> sightings, std::span<const double> weights) {
  TriangulatedPoint point;
  if (sightings.size() < 2) return point;
  point.status = PointStatus::kIllConditioned;

  Eigen::MatrixXd M(2 * sightings.size(), 3);
  Eigen::VectorXd b(2 * sightings.size());
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const auto& h = sightings[i].matrix.h;
    const double scale = weights[i] / std::sqrt(h[2][0] * h[2][0] + h[2][1] * h[2][1] + h[2][2] * h[2][2]);
    for (int k = 0; k < 2; ++k) {
      const double pixel = sightings[i].pixel[k];
      const auto row = static_cast<Eigen::Index>(2 * i + k);
      for (int column = 0; column < 3; ++column) M(row, column) = scale * (h[k][column] - h[2][column] * pixel);
      b[row] = scale * (h[2][3] * pixel - h[k][3]);
    }
  }
  if (!M.allFinite() || !b.allFinite()) return point;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(M, Eigen::ComputeThinU | Eigen::ComputeThinV);
  if (!(svd.singularValues()[2] > kParallel * svd.singularValues()[0])) return point;
  const Eigen::Vector3d V = svd.solve(b);
  const glm::dvec3 p_WQ(V[0], V[1], V[2]);
  // A camera cannot have seen a point behind it.
  const double residual = ResidualPx(sightings, p_WQ);
  if (residual < 0) return point;
  return {PointStatus::kOk, p_WQ, residual};
}

/// Returns the inverse of the matrix's left 3 × 3 block. The inverse maps pixels to directions in the world.
glm::dmat3 DirectionsOf(const ProjectionMatrix& matrix) {
  const auto& h = matrix.h;
  return glm::inverse(
      glm::transpose(glm::dmat3(h[0][0], h[0][1], h[0][2], h[1][0], h[1][1], h[1][2], h[2][0], h[2][1], h[2][2])));
}

glm::dvec3 CentreOf(const ProjectionMatrix& matrix, const glm::dmat3& directions) {
  return -(directions * glm::dvec3(matrix.h[0][3], matrix.h[1][3], matrix.h[2][3]));
}

}  // namespace

std::optional<SightLine> SightLineOf(const Sighting& sighting) {
  const auto& h = sighting.matrix.h;
  const glm::dmat3 M =
      glm::transpose(glm::dmat3(h[0][0], h[0][1], h[0][2], h[1][0], h[1][1], h[1][2], h[2][0], h[2][1], h[2][2]));
  const glm::dvec3 centre_W = -(glm::inverse(M) * glm::dvec3(h[0][3], h[1][3], h[2][3]));
  const glm::dvec3 ray_W = ViewingRay(sighting.matrix, sighting.pixel);
  const double length = glm::length(ray_W);
  if (!(length > 0) || !std::isfinite(glm::length(centre_W) / length)) return std::nullopt;
  return SightLine{centre_W, ray_W / length};
}

glm::dvec3 NearestOn(const SightLine& line, const glm::dvec3& p_WQ) {
  const double depth = std::max(0.0, glm::dot(p_WQ - line.camera_W, line.direction_W));
  return line.camera_W + depth * line.direction_W;
}

TriangulatedPoint Triangulate(std::span<const Sighting> sightings) {
  return TriangulateWeighted(sightings, std::vector<double>(sightings.size(), 1.0));
}

TriangulatedPoint TriangulateByPixels(std::span<const Sighting> sightings) {
  TriangulatedPoint point = Triangulate(sightings);
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds && point.status == PointStatus::kOk; ++round) {
    std::vector<double> weights;
    for (const Sighting& sighting : sightings) weights.push_back(1 / DepthOf(sighting.matrix, point.position));
    const TriangulatedPoint next = TriangulateWeighted(sightings, weights);
    if (next.status != PointStatus::kOk) break;
    point = next;
  }
  return point;
}

std::optional<EpipolarGeometry> EpipolarGeometry::Of(const ProjectionMatrix& first, const ProjectionMatrix& second) {
  const glm::dmat3 from_a = DirectionsOf(first), from_b = DirectionsOf(second);
  const glm::dvec3 t = CentreOf(second, from_b) - CentreOf(first, from_a);
  const glm::dmat3 cross(glm::dvec3(0, t.z, -t.y), glm::dvec3(-t.z, 0, t.x), glm::dvec3(t.y, -t.x, 0));
  EpipolarGeometry geometry;
  geometry.f_ = glm::transpose(from_b) * cross * from_a;
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(glm::length(geometry.f_[i]))) return std::nullopt;
  }
  return geometry;
}

PairGeometry::PairGeometry(std::span<const ProjectionMatrix> cameras) : cameras_(cameras.size()) {
  for (std::size_t a = 0; a < cameras_; ++a) {
    for (std::size_t b = 0; b < cameras_; ++b) {
      of_.push_back(a == b ? std::nullopt : EpipolarGeometry::Of(cameras[a], cameras[b]));
    }
  }
}

double EpipolarGeometry::DistancePx(const glm::dvec2& first, const glm::dvec2& second) const {
  const glm::dvec3 a(first, 1), b(second, 1), line_b = f_ * a, line_a = glm::transpose(f_) * b;
  const double gain = line_b.x * line_b.x + line_b.y * line_b.y + line_a.x * line_a.x + line_a.y * line_a.y;
  const double off = glm::dot(b, line_b);
  return gain > 0   ? off / std::sqrt(2 * gain)
         : off == 0 ? 0
                    : std::copysign(std::numeric_limits<double>::infinity(), off);
}

}  // namespace etude
