#include "sim/body/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace etude {
namespace {

using enum Role;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The radii of the capsules, as shares of limb lengths. With these shares, a body of 1.70 m looks like a dressed adult.
constexpr double kUpperArmPerLength = 0.155;
constexpr double kForearmPerLength = 0.145;
constexpr double kHandPerForearm = 0.13;  // the hand joint is not used: many files put this joint at the wrist
constexpr double kThighPerLength = 0.165;
constexpr double kShankPerLength = 0.12;
constexpr double kFootPerShank = 0.068;
constexpr double kPelvisPerTrunk = 0.195;
constexpr double kFlankPerTrunk = 0.19;
constexpr double kChestPerTrunk = 0.215;
constexpr double kShoulderPerTrunk = 0.13;
constexpr double kNeckPerTrunk = 0.11;
constexpr double kHeadPerTrunk = 0.185;
constexpr double kSkullPerTrunk = 0.06;       // half the length of the head's axis
constexpr double kNeckToHeadPerTrunk = 0.34;  // the head joint is not used: files put it at the head's middle or top

struct Limb {
  Part part;
  Role from, to;
  Role measured_from, measured_to;  // the bone whose length gives the radius
  double radius_per_length;
};

constexpr std::array<Limb, 12> kLimbs = {{
    {Part::kLeftUpperArm, kLeftShoulder, kLeftElbow, kLeftShoulder, kLeftElbow, kUpperArmPerLength},
    {Part::kLeftForearm, kLeftElbow, kLeftWrist, kLeftElbow, kLeftWrist, kForearmPerLength},
    {Part::kLeftHand, kLeftWrist, kLeftHand, kLeftElbow, kLeftWrist, kHandPerForearm},
    {Part::kRightUpperArm, kRightShoulder, kRightElbow, kRightShoulder, kRightElbow, kUpperArmPerLength},
    {Part::kRightForearm, kRightElbow, kRightWrist, kRightElbow, kRightWrist, kForearmPerLength},
    {Part::kRightHand, kRightWrist, kRightHand, kRightElbow, kRightWrist, kHandPerForearm},
    {Part::kLeftThigh, kLeftHip, kLeftKnee, kLeftHip, kLeftKnee, kThighPerLength},
    {Part::kLeftShank, kLeftKnee, kLeftAnkle, kLeftKnee, kLeftAnkle, kShankPerLength},
    {Part::kLeftFoot, kLeftAnkle, kLeftFoot, kLeftKnee, kLeftAnkle, kFootPerShank},
    {Part::kRightThigh, kRightHip, kRightKnee, kRightHip, kRightKnee, kThighPerLength},
    {Part::kRightShank, kRightKnee, kRightAnkle, kRightKnee, kRightAnkle, kShankPerLength},
    {Part::kRightFoot, kRightAnkle, kRightFoot, kRightKnee, kRightAnkle, kFootPerShank},
}};

/// The parts in which a joint lies: one or two.
struct OwnParts {
  Part first, second;
};

OwnParts OwnPartsOf(Role role) {
  if (role == kHead) return {Part::kHead, Part::kHead};
  if (role == kShoulderCentre) return {Part::kTrunk, Part::kHead};
  // A joint lies in the limb that ends there (otherwise in the trunk) and in the limb that begins there.
  OwnParts parts{Part::kTrunk, Part::kTrunk};
  for (const Limb& limb : kLimbs) {
    if (limb.to == role) parts = {limb.part, limb.part};
    if (limb.from == role) parts.second = limb.part;
  }
  return parts;
}

double TrunkLength(const BodyPose& pose) {
  return glm::distance(pose[kHipCentre], pose[kSpine]) + glm::distance(pose[kSpine], pose[kShoulderCentre]);
}

void AddTrunk(const BodyPose& pose, std::vector<Capsule>& body) {
  const double length = TrunkLength(pose);
  // Place the widest point of the ribs at this share of the way from the middle of the back to the shoulder, on each
  // side.
  constexpr double kRibs = 0.45;
  const glm::dvec3 middle = 0.5 * (pose[kSpine] + pose[kShoulderCentre]);
  const glm::dvec3 left_rib = glm::mix(middle, pose[kLeftShoulder], kRibs);
  const glm::dvec3 right_rib = glm::mix(middle, pose[kRightShoulder], kRibs);
  const auto add = [&](const glm::dvec3& a, const glm::dvec3& b, double share) {
    body.push_back({Part::kTrunk, a, b, share * length});
  };
  add(pose[kLeftHip], pose[kRightHip], kPelvisPerTrunk);
  add(pose[kHipCentre], pose[kSpine], kChestPerTrunk);
  add(pose[kSpine], middle, kChestPerTrunk);
  add(pose[kLeftHip], left_rib, kFlankPerTrunk);
  add(pose[kRightHip], right_rib, kFlankPerTrunk);
  add(left_rib, right_rib, kChestPerTrunk);
  add(pose[kLeftShoulder], pose[kRightShoulder], kShoulderPerTrunk);
}

void AddHead(const BodyPose& pose, std::vector<Capsule>& body) {
  const double trunk = TrunkLength(pose);
  const glm::dvec3 neck = pose[kHead] - pose[kShoulderCentre];
  const double length = glm::length(neck);
  const glm::dvec3 up = length > 0 ? neck / length : glm::dvec3(0, 1, 0);
  const glm::dvec3 middle = pose[kShoulderCentre] + up * std::min(length, kNeckToHeadPerTrunk * trunk);
  body.push_back({Part::kHead, pose[kShoulderCentre], middle, kNeckPerTrunk * trunk});
  const glm::dvec3 half = up * (kSkullPerTrunk * trunk);
  body.push_back({Part::kHead, middle - half, middle + half, kHeadPerTrunk * trunk});
}

/// Returns the smaller root of t² + 2bt + c = 0, or infinity if the smaller root is negative or there is none.
double EntryRoot(double b, double c) {
  const double discriminant = b * b - c;
  if (discriminant < 0) return kInfinity;
  const double t = -b - std::sqrt(discriminant);
  return t >= 0 ? t : kInfinity;
}

double SphereEntry(const glm::dvec3& centre, double radius, const glm::dvec3& origin, const glm::dvec3& direction) {
  const glm::dvec3 from = origin - centre;
  return EntryRoot(glm::dot(from, direction), glm::dot(from, from) - radius * radius);
}

bool IsInside(const Capsule& capsule, const glm::dvec3& point) {
  const glm::dvec3 axis = capsule.b - capsule.a;
  const double squared = glm::dot(axis, axis);
  const double along = squared > 0 ? std::clamp(glm::dot(point - capsule.a, axis) / squared, 0.0, 1.0) : 0.0;
  const glm::dvec3 off = point - (capsule.a + along * axis);
  return glm::dot(off, off) <= capsule.radius * capsule.radius;
}

BoundingSphere SphereAround(const Capsule& capsule, const glm::dvec3& eye) {
  constexpr double kAir = 1e-6;  // a margin larger than any rounding error, metres
  const glm::dvec3 from = eye - 0.5 * (capsule.a + capsule.b);
  const double radius = 0.5 * glm::length(capsule.b - capsule.a) + capsule.radius + kAir;
  return {from, glm::dot(from, from) - radius * radius};
}

/// Returns true if the ray misses the sphere. Most rays do.
bool PassesBy(const BoundingSphere& sphere, const glm::dvec3& direction) {
  const double along = glm::dot(sphere.from, direction);
  return sphere.outside > 0 && (along > 0 || along * along < sphere.outside);
}

/// Returns the distance at which the ray enters the cylinder between the two half-spheres.
double SideEntry(const Capsule& capsule, const glm::dvec3& origin, const glm::dvec3& direction) {
  const glm::dvec3 axis = capsule.b - capsule.a;
  const double length = glm::length(axis);
  if (length == 0) return kInfinity;
  const glm::dvec3 unit = axis / length;
  const glm::dvec3 from = origin - capsule.a;
  const glm::dvec3 across = direction - glm::dot(direction, unit) * unit;
  const glm::dvec3 from_across = from - glm::dot(from, unit) * unit;
  const double scale = glm::dot(across, across);
  constexpr double kParallel = 1e-18;  // squared sine of the angle to the axis; below it, rays hit a half-sphere first
  if (scale < kParallel) return kInfinity;
  const double t = EntryRoot(glm::dot(from_across, across) / scale,
                             (glm::dot(from_across, from_across) - capsule.radius * capsule.radius) / scale);
  const double along = glm::dot(from + t * direction, unit);
  return t < kInfinity && along >= 0 && along <= length ? t : kInfinity;
}

// Rotates a vector about the vertical from the world's axes to the box's axes.
glm::dvec3 Turned(const glm::dvec3& v, double sine, double cosine) {
  return {cosine * v.x - sine * v.z, v.y, sine * v.x + cosine * v.z};
}

/// Returns the distance along a ray that does not miss the capsule's bounding sphere.
double HitDistanceNear(const Capsule& capsule, const glm::dvec3& origin, const glm::dvec3& direction) {
  if (IsInside(capsule, origin)) return 0;
  return std::min({SideEntry(capsule, origin, direction), SphereEntry(capsule.a, capsule.radius, origin, direction),
                   SphereEntry(capsule.b, capsule.radius, origin, direction)});
}

}  // namespace

std::vector<Capsule> BodyCapsules(const BodyPose& pose) {
  std::vector<Capsule> body;
  body.reserve(kLimbs.size() + 9);
  AddTrunk(pose, body);
  AddHead(pose, body);
  for (const Limb& limb : kLimbs) {
    const double length = glm::distance(pose[limb.measured_from], pose[limb.measured_to]);
    body.push_back({limb.part, pose[limb.from], pose[limb.to], limb.radius_per_length * length});
  }
  return body;
}

double HitDistance(const Capsule& capsule, const glm::dvec3& origin, const glm::dvec3& direction) {
  if (PassesBy(SphereAround(capsule, origin), direction)) return kInfinity;
  return HitDistanceNear(capsule, origin, direction);
}

BodySight::BodySight(const BodyPose& pose, const glm::dvec3& eye) : pose_(pose), eye_(eye) {
  for (const Capsule& capsule : BodyCapsules(pose)) capsules_.push_back({capsule, SphereAround(capsule, eye)});
}

JointSight BodySight::Of(Role role) const {
  const glm::dvec3 line = pose_[role] - eye_;
  const double distance = glm::length(line);
  JointSight sight{.skin = distance, .other = kInfinity};
  if (distance == 0) return sight;
  const glm::dvec3 direction = line / distance;
  const auto [first, second] = OwnPartsOf(role);
  for (const SeenCapsule& seen : capsules_) {
    if (PassesBy(seen.sphere, direction)) continue;
    const Part part = seen.capsule.part;
    double& nearest = part == first || part == second ? sight.skin : sight.other;
    nearest = std::min(nearest, HitDistanceNear(seen.capsule, eye_, direction));
  }
  return sight;
}

bool IsHidden(const BodyPose& pose, Role role, const glm::dvec3& eye) {
  const JointSight sight = BodySight(pose, eye).Of(role);
  return sight.other < sight.skin - kHidingClearance;
}

double HitDistance(const Cuboid& box, const glm::dvec3& origin, const glm::dvec3& direction) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double sine = std::sin(box.heading), cosine = std::cos(box.heading);
  const glm::dvec3 from = Turned(origin - box.centre, sine, cosine), along = Turned(direction, sine, cosine);
  double enter = 0, leave = kInfinity;
  // Intersect the ray with the three slabs between opposite faces of the box.
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
