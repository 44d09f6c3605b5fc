#include "engine/retargeting/joint_map.h"

#include <algorithm>
#include <optional>
#include <span>

#include "engine/base/names.h"
#include "engine/retargeting/joint_names.h"

namespace etude {
namespace {

using enum Role;

// Tips relative to the limb they end (an adult's, cm).
constexpr double kHandPerForearm = 18.0 / 25.0;
constexpr double kFootPerShank = 18.0 / 42.0;
constexpr double kHeadPerTrunk = 25.0 / 50.0;
// A tip is believed when its length is within these factors of the proportion above: CMU's fingers are
// half as long as a hand, Boxing_Toes' feet 1.4 times as long as paper B's.
constexpr double kShortestTip = 0.4;
constexpr double kLongestTip = 1.6;

struct Limb {
  std::array<Role, 3> roles;
  Role tip;
  Side side;
  bool is_arm;
};

constexpr std::array<Limb, 4> kLimbs = {{
    {{kLeftShoulder, kLeftElbow, kLeftWrist}, kLeftHand, Side::kLeft, true},
    {{kRightShoulder, kRightElbow, kRightWrist}, kRightHand, Side::kRight, true},
    {{kLeftHip, kLeftKnee, kLeftAnkle}, kLeftFoot, Side::kLeft, false},
    {{kRightHip, kRightKnee, kRightAnkle}, kRightFoot, Side::kRight, false},
}};

class MapFinder {
 public:
  MapFinder(const Skeleton& skeleton, const std::string& file) : skeleton_(skeleton), file_(file) {
    for (const Joint& joint : skeleton.joints) {
      rest_.push_back(joint.rest.translation + (joint.parent < 0 ? glm::dvec3(0) : rest_[joint.parent]));
    }
  }

  Result<JointMap> Find() {
    for (const Limb& limb : kLimbs) FindLimb(limb);
    FindFirst(kShoulderCentre, NeckNames());
    FindFirst(kHead, HeadNames());
    if (auto ok = CheckNoneMissing(); !ok) return tl::unexpected(ok.error());
    FindTrunk();
    if (auto ok = CheckTree(); !ok) return tl::unexpected(ok.error());
    if (auto ok = CheckSides(); !ok) return tl::unexpected(ok.error());
    for (const Limb& limb : kLimbs) FindLimbTip(limb);
    FindHeadTip();
    return std::move(map_);
  }

 private:
  int JointOf(Role role) const { return map_[role].joint; }
  glm::dvec3 RestOf(Role role) const { return rest_[JointOf(role)]; }
  void Set(Role role, int joint) { map_.points[Index(role)] = {.joint = joint}; }
  const std::string& NameOf(Role role) const { return skeleton_.joints[JointOf(role)].name; }

  bool DescendsFrom(int joint, int ancestor) const {
    while (joint > ancestor) joint = skeleton_.joints[joint].parent;  // parents stand first
    return joint == ancestor;
  }

  int CommonAncestor(int a, int b) const {
    while (a != b) (a > b ? a : b) = skeleton_.joints[std::max(a, b)].parent;
    return a;
  }

  /// The first scheme that names all three joints of the limb; roles stay unset when none does.
  void FindLimb(const Limb& limb) {
    for (const LimbNames& scheme : limb.is_arm ? ArmSchemes() : LegSchemes()) {
      std::array<int, 3> found;
      for (std::size_t i = 0; i < 3; ++i) found[i] = FindJoint(skeleton_, scheme.joints[i], limb.side);
      if (std::ranges::find(found, -1) != found.end()) continue;
      for (std::size_t i = 0; i < 3; ++i) Set(limb.roles[i], found[i]);
      return;
    }
  }

  void FindFirst(Role role, std::span<const std::string_view> names) {
    for (std::string_view name : names) {
      if (JointOf(role) < 0) Set(role, FindJoint(skeleton_, name));
    }
  }

  Result<void> CheckNoneMissing() const {
    std::vector<std::string> missing;
    const auto check = [&](Role role) {
      if (JointOf(role) < 0) missing.emplace_back(RoleName(role));
    };
    check(kShoulderCentre);
    check(kHead);
    for (const Limb& limb : kLimbs) std::ranges::for_each(limb.roles, check);
    if (missing.empty()) return {};

    constexpr std::size_t kShownNames = 60;
    std::vector<std::string> seen;
    for (const Joint& joint : skeleton_.joints) {
      if (!joint.is_end_site && seen.size() < kShownNames) seen.push_back(Quote(joint.name));
    }
    return Fail({file_}, "no joint found for {}; joints in the file: {}", Join(missing), Join(seen));
  }

  /// Hip centre and spine, from the build of the trunk.
  void FindTrunk() {
    const int pelvis = CommonAncestor(JointOf(kLeftHip), JointOf(kRightHip));
    Set(kHipCentre, pelvis);
    // Distances along the chain do not depend on the rest pose, which some files have folded up.
    std::vector<int> chain;
    double length = 0;
    for (int joint = JointOf(kShoulderCentre); joint > pelvis; joint = skeleton_.joints[joint].parent) {
      chain.push_back(joint);
      length += glm::length(skeleton_.joints[joint].rest.translation);
    }
    double from_neck = 0;
    double nearest = length;
    for (std::size_t i = 1; i < chain.size(); ++i) {
      from_neck += glm::length(skeleton_.joints[chain[i - 1]].rest.translation);
      const double distance = std::abs(from_neck - 0.5 * length);
      if (distance >= nearest) continue;
      nearest = distance;
      Set(kSpine, chain[i]);
    }
    if (JointOf(kSpine) < 0) Compose(kSpine, pelvis, 0.5 * (RestOf(kShoulderCentre) + rest_[pelvis]));
  }

  Result<void> CheckTree() const {
    const auto check = [&](Role child, Role parent) -> Result<void> {
      if (JointOf(child) != JointOf(parent) && DescendsFrom(JointOf(child), JointOf(parent))) return {};
      return Fail({file_}, "{} is played by {}, which does not descend from {}, the {}", RoleName(child),
                  Quote(NameOf(child)), Quote(NameOf(parent)), RoleName(parent));
    };
    std::vector<Bone> pairs = {{kHipCentre, kShoulderCentre}, {kShoulderCentre, kHead}};
    for (const Limb& limb : kLimbs) {
      pairs.push_back({kHipCentre, limb.roles[0]});
      pairs.push_back({limb.roles[0], limb.roles[1]});
      pairs.push_back({limb.roles[1], limb.roles[2]});
    }
    for (const Bone& pair : pairs) {
      if (auto ok = check(pair.child, pair.parent); !ok) return ok;
    }
    return {};
  }

  Result<void> CheckSides() const {
    const glm::dvec3 across = RestOf(kLeftHip) - RestOf(kRightHip);
    const double left = glm::dot(RestOf(kLeftHip) - RestOf(kHipCentre), across);
    const double right = glm::dot(RestOf(kRightHip) - RestOf(kHipCentre), across);
    if (left > 0 && right < 0) return {};
    return Fail({file_}, "{} and {} lie on the same side of {} in the rest pose; a left and a right hip are needed",
                Quote(NameOf(kLeftHip)), Quote(NameOf(kRightHip)), Quote(NameOf(kHipCentre)));
  }

  /// A point fixed to `joint` that is at `rest` in the rest pose.
  void Compose(Role role, int joint, const glm::dvec3& rest) {
    map_.points[Index(role)] = {.joint = joint, .offset = rest - rest_[joint]};
    map_.composed.push_back(role);
  }

  /// The farthest descendant of `top` (or `top` itself) from `base`, if any is at a believable distance.
  std::optional<int> FarthestTip(int top, const glm::dvec3& base, double proportion) const {
    std::optional<int> farthest;
    double length = 0;
    for (std::size_t i = top; i < rest_.size(); ++i) {
      const double distance = glm::distance(rest_[i], base);
      const bool believable = distance >= kShortestTip * proportion && distance <= kLongestTip * proportion;
      if (!believable || distance <= length || !DescendsFrom(static_cast<int>(i), top)) continue;
      farthest = static_cast<int>(i);
      length = distance;
    }
    return farthest;
  }

  void FindLimbTip(const Limb& limb) {
    const glm::dvec3 end = RestOf(limb.roles[2]);
    const glm::dvec3 last_bone = end - RestOf(limb.roles[1]);
    const double length = glm::length(last_bone) * (limb.is_arm ? kHandPerForearm : kFootPerShank);
    if (auto tip = FarthestTip(JointOf(limb.roles[2]), end, length)) return Set(limb.tip, *tip);
    const glm::dvec3 direction = limb.is_arm ? last_bone : RestForward();
    const double size = glm::length(direction);
    Compose(limb.tip, JointOf(limb.roles[2]), size > 0 ? end + direction * (length / size) : end);
  }

  void FindHeadTip() {
    const glm::dvec3 neck = RestOf(kShoulderCentre);
    const glm::dvec3 trunk = neck - 0.5 * (RestOf(kLeftHip) + RestOf(kRightHip));
    const int head = JointOf(kHead);
    if (auto tip = FarthestTip(head, neck, glm::length(trunk) * kHeadPerTrunk)) return Set(kHead, *tip);
    Compose(kHead, head, neck + trunk * kHeadPerTrunk);
  }

  glm::dvec3 RestForward() const {
    return glm::cross(RestOf(kLeftHip) - RestOf(kRightHip), RestOf(kShoulderCentre) - RestOf(kHipCentre));
  }

  const Skeleton& skeleton_;
  const std::string& file_;
  std::vector<glm::dvec3> rest_;  ///< every joint's place in the rest pose
  JointMap map_;
};

}  // namespace

Result<JointMap> FindJointMap(const Skeleton& skeleton, const std::string& file, const TaughtRoles*) {
  return MapFinder(skeleton, file).Find();
}

BodyPose Evaluate(const JointMap& map, const std::vector<GlobalTransform>& globals) {
  BodyPose pose;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    const RolePoint& point = map.points[i];
    const GlobalTransform& carrier = globals[point.joint];
    pose.joints[i] = carrier.position + carrier.axes * point.offset;
  }
  pose[kHipCentre] = 0.5 * (pose[kLeftHip] + pose[kRightHip]);
  return pose;
}

}  // namespace etude
