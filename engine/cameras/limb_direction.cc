#include "engine/cameras/limb_direction.h"

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "engine/base/directions.h"

namespace etude {
namespace {

// Two rays span no plane if the angle between them is smaller than this, radians. At a focal length of 600 pixels, this
// angle is 0.006 pixel.
constexpr double kSamePixel = 1e-5;

// Returns the planes of all strokes that are long enough to span a plane.
std::vector<StrokePlane> PlanesOf(std::span<const LimbSighting> sightings) {
  std::vector<StrokePlane> planes;
  for (const LimbSighting& sighting : sightings) {
    if (const auto plane = PlaneOf(sighting)) planes.push_back(*plane);
  }
  return planes;
}

double LargestPlaneAngle(std::span<const StrokePlane> planes) {
  double largest = 0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      const double between_normals = AngleBetween(planes[i].normal_W, planes[j].normal_W);
      largest = std::max(largest, std::min(between_normals, kPi - between_normals));
    }
  }
  return largest;
}

// Returns the unit vector most nearly perpendicular to all weighted normals; its sign is arbitrary. For three or more
// planes it is the right singular vector of the smallest singular value.
glm::dvec3 LineAlong(std::span<const StrokePlane> planes, std::span<const double> weights) {
  if (planes.size() == 2) return glm::normalize(glm::cross(planes[0].normal_W, planes[1].normal_W));
  Eigen::MatrixXd normals(planes.size(), 3);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const glm::dvec3 n = weights[i] * planes[i].normal_W;
    normals.row(static_cast<Eigen::Index>(i)) << n.x, n.y, n.z;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(normals, Eigen::ComputeFullV);
  const Eigen::Vector3d along_W = svd.matrixV().col(2);
  return {along_W[0], along_W[1], along_W[2]};
}

// Returns the weight 1/ε of each plane, scaled so that the largest weight is 1. ε is the error of Nᵢ·d if the ends of
// the stroke are wrong by one pixel.
std::vector<double> WeightsOf(std::span<const StrokePlane> planes, const glm::dvec3& along_W) {
  std::vector<double> weights;
  // Minimum sine of the angle between limb and ray; it limits the weight of a limb that lies along the line of sight.
  constexpr double kEndOn = 0.05;
  for (const StrokePlane& plane : planes) {
    const glm::dvec3 middle = glm::normalize(plane.ray_a_W + plane.ray_b_W);
    weights.push_back(plane.length_px / std::max(kEndOn, glm::length(glm::cross(middle, along_W))));
  }
  const double largest = *std::ranges::max_element(weights);
  for (double& weight : weights) weight /= largest;
  return weights;
}

// Returns a value in [−1, 1] that is positive if a point on ray a, moving along `direction`, moves towards ray b in the
// picture: with direction = α·a + β·b within the plane, the value has the sign of β.
double Sense(const StrokePlane& plane, const glm::dvec3& direction_W) {
  return glm::dot(glm::cross(plane.ray_a_W, direction_W), plane.normal_W);
}

}  // namespace

glm::dvec3 ViewingRay(const ProjectionMatrix& matrix, const glm::dvec2& pixel) {
  const auto& h = matrix.h;
  const glm::dvec3 h1(h[0][0], h[0][1], h[0][2]), h2(h[1][0], h[1][1], h[1][2]), h3(h[2][0], h[2][1], h[2][2]);
  const glm::dvec3 ray_W = glm::cross(h1 - pixel.x * h3, h2 - pixel.y * h3);
  return glm::dot(h3, ray_W) < 0 ? -ray_W : ray_W;  // w must increase along the ray
}

std::optional<StrokePlane> PlaneOf(const LimbSighting& sighting) {
  const auto& [matrix, stroke] = sighting;
  const glm::dvec3 a_W = glm::normalize(ViewingRay(matrix, stroke.a)),
                   b_W = glm::normalize(ViewingRay(matrix, stroke.b));
  const glm::dvec3 normal_W = glm::cross(a_W, b_W);
  const double length = glm::length(normal_W);
  if (!(length > kSamePixel)) return std::nullopt;  // NaN is refused, too
  return StrokePlane{normal_W / length, a_W, b_W, glm::distance(stroke.a, stroke.b)};
}

LimbDirection ComputeLimbDirection(std::span<const LimbSighting> sightings, double min_plane_angle) {
  const std::vector<StrokePlane> planes = PlanesOf(sightings);
  LimbDirection limb;
  limb.plane_angle = LargestPlaneAngle(planes);
  if (limb.plane_angle < std::max(min_plane_angle, kSamePixel)) return limb;

  // Solve with equal weights, then with the weights that follow from that solution.
  const std::vector<double> alike(planes.size(), 1.0);
  const glm::dvec3 along_W = LineAlong(planes, WeightsOf(planes, LineAlong(planes, alike)));
  double sense = 0;
  for (const StrokePlane& plane : planes) sense += Sense(plane, along_W);
  return {DirectionStatus::kOk, sense < 0 ? -along_W : along_W, limb.plane_angle};
}

}  // namespace etude
