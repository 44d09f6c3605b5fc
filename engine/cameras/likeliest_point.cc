#include "engine/cameras/likeliest_point.h"

#include <cmath>
#include <vector>

namespace etude {

std::optional<PointEquations> PointEquationsAt(std::span<const InformedSighting> sightings, const glm::dvec3& p_WQ) {
  PointEquations sum;
  for (const InformedSighting& seen : sightings) {
    const auto pixel = Project(seen.sighting.matrix, p_WQ);
    if (!pixel) return std::nullopt;
    const auto& h = seen.sighting.matrix.h;
    const double depth = h[2][0] * p_WQ.x + h[2][1] * p_WQ.y + h[2][2] * p_WQ.z + h[2][3];
    glm::dmat3x2 gains;  // of u and v, column by column for x, y, z
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 2; ++k) gains[axis][k] = (h[k][axis] - (*pixel)[k] * h[2][axis]) / depth;
    }
    const glm::dmat2x3 transposed = glm::transpose(gains);
    sum.information += transposed * seen.information * gains;
    sum.right += transposed * (seen.information * (seen.sighting.pixel - *pixel));
  }
  return sum;
}

std::optional<LikeliestPoint> TriangulateLikeliest(std::span<const InformedSighting> sightings) {
  std::vector<Sighting> plain;
  for (const InformedSighting& seen : sightings) plain.push_back(seen.sighting);
  const TriangulatedPoint linear = Triangulate(plain);
  if (linear.status != PointStatus::kOk) return std::nullopt;
  glm::dvec3 place = linear.position;
  constexpr int kSteps = 5;
  for (int i = 0; i < kSteps; ++i) {
    const auto sum = PointEquationsAt(sightings, place);
    if (!sum) return std::nullopt;
    place += glm::inverse(sum->information) * sum->right;
  }
  const auto sum = PointEquationsAt(sightings, place);
  if (!sum || !std::isfinite(glm::length(place)) || !(glm::determinant(sum->information) > 0)) return std::nullopt;
  return LikeliestPoint{place, sum->information};
}

}  // namespace etude
