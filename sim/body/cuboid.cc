#include "sim/body/cuboid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace etude {
namespace {

// From the world's axes to the box's.
glm::dvec3 Turned(const glm::dvec3& v, double sine, double cosine) {
  return {cosine * v.x - sine * v.z, v.y, sine * v.x + cosine * v.z};
}

}  // namespace

double HitDistance(const Cuboid& box, const glm::dvec3& origin, const glm::dvec3& direction) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double sine = std::sin(box.heading), cosine = std::cos(box.heading);
  const glm::dvec3 from = Turned(origin - box.centre, sine, cosine), along = Turned(direction, sine, cosine);
  double enter = 0, leave = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    if (along[axis] == 0) {
      if (std::abs(from[axis]) > box.half_size[axis]) return kInfinity;
      continue;
    }
    double near = (-box.half_size[axis] - from[axis]) / along[axis];
    double far = (box.half_size[axis] - from[axis]) / along[axis];
    if (near > far) std::swap(near, far);
    enter = std::max(enter, near);
    leave = std::min(leave, far);
  }
  return enter <= leave ? enter : kInfinity;
}

}  // namespace etude
