#include "tests/sim/choreography/balance.h"

#include <algorithm>
#include <limits>

#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

using enum Role;

struct Segment {
  Role from, to;
  double mass;    // share of the body's mass
  double centre;  // share of the way along the segment
};

constexpr double kLowerTrunk = CanonicalBody::kSpine / (CanonicalBody::kSpine + CanonicalBody::kChest);
constexpr Segment kSegments[] = {
    {kHipCentre, kSpine, 0.497 * kLowerTrunk, 0.5},
    {kSpine, kShoulderCentre, 0.497 * (1 - kLowerTrunk), 0.5},
    {kShoulderCentre, kHead, 0.081, 1},
    {kLeftShoulder, kLeftElbow, 0.028, 0.436},
    {kRightShoulder, kRightElbow, 0.028, 0.436},
    {kLeftElbow, kLeftWrist, 0.016, 0.430},
    {kRightElbow, kRightWrist, 0.016, 0.430},
    {kLeftWrist, kLeftHand, 0.006, 0.506},
    {kRightWrist, kRightHand, 0.006, 0.506},
    {kLeftHip, kLeftKnee, 0.100, 0.433},
    {kRightHip, kRightKnee, 0.100, 0.433},
    {kLeftKnee, kLeftAnkle, 0.0465, 0.433},
    {kRightKnee, kRightAnkle, 0.0465, 0.433},
    {kLeftAnkle, kLeftFoot, 0.0145, 0.5},
    {kRightAnkle, kRightFoot, 0.0145, 0.5},
};

double Cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Returns the convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<glm::dvec2> ConvexHull(std::vector<glm::dvec2> points) {
  std::ranges::sort(points, [](const auto& a, const auto& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<glm::dvec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t base = hull.size();
    for (const glm::dvec2& point : points) {
      while (hull.size() >= base + 2 && Cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0) {
        hull.pop_back();
      }
      hull.push_back(point);
    }
    hull.pop_back();  // the other half begins with this point
    std::ranges::reverse(points);
  }
  return hull;
}

}  // namespace

glm::dvec3 CentreOfMass(const BodyPose& pose) {
  glm::dvec3 centre(0);
  for (const Segment& segment : kSegments) {
    centre += segment.mass * glm::mix(pose[segment.from], pose[segment.to], segment.centre);
  }
  return centre;
}

std::vector<glm::dvec2> Sole(const BodyPose& pose, Side side) {
  constexpr double kTouching = 0.005, kHeelDown = 0.01;
  constexpr double kHalfWidth = 0.045, kHeelBehindAnkle = 0.055, kBall = 0.07;
  const glm::dvec3& ankle = pose[side == Side::kLeft ? kLeftAnkle : kRightAnkle];
  const glm::dvec3& toe = pose[side == Side::kLeft ? kLeftFoot : kRightFoot];
  if (toe.y > CanonicalBody::kToeHeight + kTouching) return {};
  const bool heel_down = ankle.y < CanonicalBody::kAnkleHeight + kHeelDown;
  const double length = heel_down ? CanonicalBody::kFootReach + kHeelBehindAnkle : kBall;
  const glm::dvec2 tip(toe.x, toe.z), along = glm::normalize(tip - glm::dvec2(ankle.x, ankle.z));
  const glm::dvec2 across = kHalfWidth * glm::dvec2(-along.y, along.x), back = tip - length * along;
  return {tip - across, tip + across, back - across, back + across};
}

double DistanceOutside(const glm::dvec2& point, std::vector<glm::dvec2> corners) {
  const std::vector<glm::dvec2> hull = ConvexHull(std::move(corners));
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const glm::dvec2 from = hull[i], edge = hull[(i + 1) % hull.size()] - from;
    inside = inside && Cross(edge, point - from) >= 0;
    const double share = std::clamp(glm::dot(point - from, edge) / glm::dot(edge, edge), 0.0, 1.0);
    nearest = std::min(nearest, glm::distance(point, from + share * edge));
  }
  return inside ? 0 : nearest;
}

}  // namespace etude
