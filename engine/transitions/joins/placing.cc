#include "engine/transitions/joins/placing.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/angles.h"
#include "engine/motion/support.h"
#include "engine/transitions/joins/planted_feet.h"

namespace etude {
namespace {

/// Fits a rotation about the vertical and a shift on the floor by weighted least squares. Rotation and shift align the
/// second point of each pair with the pair's first point.
class FloorFit {
 public:
  void Add(const glm::dvec3& onto, const glm::dvec3& point, double weight) {
    pairs_.push_back({{onto.x, onto.z}, {point.x, point.z}, weight});
    weight_ += weight;
    onto_ += weight * pairs_.back().onto;
    point_ += weight * pairs_.back().point;
  }

  /// Returns the best rotation about the vertical, radians.
  double Yaw() const {
    const glm::dvec2 onto = onto_ / weight_, point = point_ / weight_;
    double along = 0, across = 0;
    for (const Pair& pair : pairs_) {
      const glm::dvec2 o = pair.onto - onto, p = pair.point - point;
      along += pair.weight * glm::dot(o, p);
      across += pair.weight * (o.x * p.y - o.y * p.x);
    }
    return std::atan2(across, along);
  }

  /// Returns the floor move with the rotation `yaw` and the shift that fits best after this rotation.
  FloorMove Turned(double yaw) const {
    const glm::dvec2 onto = onto_ / weight_, point = point_ / weight_;
    const glm::dvec3 moved = FloorMove{.yaw = yaw}.Apply(glm::dvec3(point.x, 0, point.y));
    return {.yaw = yaw, .x = onto.x - moved.x, .z = onto.y - moved.z};
  }

 private:
  struct Pair {
    glm::dvec2 onto, point;
    double weight;
  };
  std::vector<Pair> pairs_;
  double weight_ = 0;
  glm::dvec2 onto_{0}, point_{0};
};

}  // namespace

FloorMove AlignOnPlantedFeet(std::span<const BodyPose> old, std::span<const BodyPose> next, double rate_hz) {
  // Fit hips and shoulders first; the feet may rotate the body relative to this fit.
  FloorFit fit;
  constexpr double kTrunk = 0.05, kFeet = 0.1, kMaxTurn = Radians(30);
  for (Role role : {Role::kLeftHip, Role::kRightHip, Role::kLeftShoulder, Role::kRightShoulder}) {
    fit.Add(old[0][role], next[0][role], kTrunk);
  }
  const double facing = fit.Yaw();
  // Add the feet that stand in both motions at the same frame.
  const FootContacts stands_old = FindFootContacts(old, rate_hz), stands_next = FindFootContacts(next, rate_hz);
  for (std::size_t side = 0; side < kLegs.size(); ++side) {
    for (std::size_t f = 0; f < std::min(old.size(), next.size()); ++f) {
      if (!stands_old[side][f] || !stands_next[side][f]) continue;
      for (Role role : {kLegs[side].foot, kLegs[side].ankle}) fit.Add(old[f][role], next[f][role], kFeet);
    }
  }
  // Limit how far the feet may rotate the body.
  return fit.Turned(facing + std::clamp(std::remainder(fit.Yaw() - facing, 2 * kPi), -kMaxTurn, kMaxTurn));
}

glm::dvec3 CarriedShift(const PosePair& leaving, const BodyPose& left, const PosePair& arriving, int frames) {
  const glm::dvec3 start = MassCentre(leaving.now) - MassCentre(leaving.before);
  const glm::dvec3 end = MassCentre(arriving.now), end_velocity = end - MassCentre(arriving.before);
  const glm::dvec3 shift = MassCentre(left) + 0.5 * frames * (start + end_velocity) - end;
  return {shift.x, 0, shift.z};
}

}  // namespace etude
