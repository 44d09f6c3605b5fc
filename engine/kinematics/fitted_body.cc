#include <algorithm>
#include <array>
#include <utility>

#include "engine/base/angles.h"
#include "engine/kinematics/capture_body.h"

namespace etude {
namespace {

using enum Role;

constexpr double kSamePositionM = 1e-6;
constexpr double kMinLimbLengthM = 1e-4;
constexpr double kMaxOffLineM = 1e-4;
// A range that never limits an angle: start angles are within half a turn of zero, and an angle would have to turn by a
// whole turn to reach ±3π.
constexpr double kUnlimited = 3 * kPi;
// The largest absolute angle of a joint that coincides with no role, radians.
constexpr double kMaxHiddenAngle = Radians(90);
const glm::dvec3 kToTheRight(-1, 0, 0), kDownwards(0, -1, 0), kAhead(0, 0, 1);

bool AreSame(const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) < kSamePositionM; }

/// One rigid part of the body in the rest pose: all points that move with one joint.
struct Part {
  std::string name;
  int parent = -1;
  glm::dvec3 at{0};  ///< position of the joint about which the part turns relative to its parent
  bool is_left_out = false;
};

/// The rest body as rigid parts. Part 0 need not be the pelvis; `pelvis()` returns the pelvis.
class Parts {
 public:
  explicit Parts(const RestBody& rest) : pelvis_(rest.roles[Index(kHipCentre)].joint) {
    for (const RestBody::Joint& joint : rest.joints) all_.push_back({joint.name, joint.parent, joint.position});
    for (const Role role : AllRoles()) carrier_[Index(role)] = rest.roles[Index(role)].joint;
    positions_ = rest.Pose();
    all_[pelvis_].parent = -1;
  }

  /// Returns true if every role belongs to the pelvis or to a descendant of the pelvis.
  bool AreConnected() const {
    return std::ranges::all_of(AllRoles(), [&](Role role) { return IsBelowPelvis(carrier_[Index(role)]); });
  }

  /// Removes the parts that do not descend from the pelvis, and the descendants without tips (`TipsOf`). If a part
  /// turns about the same point as its parent, it becomes a child of its grandparent.
  void Simplify() {
    for (std::size_t i = 0; i < all_.size(); ++i) all_[i].is_left_out = !IsBelowPelvis(static_cast<int>(i));
    for (const Role role : AllRoles()) AssignToParent(role);
    while (LeaveOutOne() || ReattachOne()) {
    }
  }

  int pelvis() const { return pelvis_; }
  std::size_t size() const { return all_.size(); }
  const Part& operator[](int part) const { return all_[part]; }
  int CarrierOf(Role role) const { return carrier_[Index(role)]; }
  const BodyPose& places() const { return positions_; }

  std::vector<int> ChildrenOf(int part) const {
    std::vector<int> children;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (!all_[i].is_left_out && all_[i].parent == part) children.push_back(static_cast<int>(i));
    }
    return children;
  }

  /// Returns the positions of a part's children and roles, without those that coincide with the part's own joint.
  std::vector<glm::dvec3> TipsOf(int part) const {
    std::vector<glm::dvec3> tips;
    for (const Role role : AllRoles()) {
      if (carrier_[Index(role)] == part && !AreSame(positions_[role], all_[part].at)) tips.push_back(positions_[role]);
    }
    for (const int child : ChildrenOf(part)) {
      if (!AreSame(all_[child].at, all_[part].at)) tips.push_back(all_[child].at);
    }
    return tips;
  }

 private:
  bool IsBelowPelvis(int part) const {
    while (part >= 0 && part != pelvis_) part = all_[part].parent;
    return part == pelvis_;
  }

  // Moves all children and roles of part `from` to part `to`, and removes `from`.
  void MoveAll(int from, int to) {
    for (Part& part : all_) {
      if (part.parent == from) part.parent = to;
    }
    for (int& carrier : carrier_) {
      if (carrier == from) carrier = to;
    }
    all_[from].is_left_out = true;
  }

  // A role at a joint marks the end of the limb above that joint, so it belongs to the part above.
  void AssignToParent(Role role) {
    int& carrier = carrier_[Index(role)];
    while (carrier != pelvis_ && AreSame(all_[carrier].at, positions_[role])) carrier = all_[carrier].parent;
  }

  // Removes one part without tips (`TipsOf`). Returns false if every part has tips.
  bool LeaveOutOne() {
    for (std::size_t i = 0; i < all_.size(); ++i) {
      const int part = static_cast<int>(i);
      if (all_[i].is_left_out || part == pelvis_ || !TipsOf(part).empty()) continue;
      MoveAll(part, all_[i].parent);
      return true;
    }
    return false;
  }

  // If a part and its parent turn about the same point, attaches the part to its grandparent. Returns false if there is
  // no such part.
  bool ReattachOne() {
    for (Part& part : all_) {
      if (part.is_left_out || part.parent < 0 || part.parent == pelvis_) continue;
      if (!AreSame(part.at, all_[part.parent].at)) continue;
      part.parent = all_[part.parent].parent;
      return true;
    }
    return false;
  }

  int pelvis_;
  std::vector<Part> all_;
  std::array<int, kRoleCount> carrier_{};
  BodyPose positions_;
};

bool IsArm(Role role) {
  constexpr std::array kArms = {kLeftShoulder,  kLeftElbow,  kLeftWrist,  kLeftHand,
                                kRightShoulder, kRightElbow, kRightWrist, kRightHand};
  return std::ranges::find(kArms, role) != kArms.end();
}

/// One limb of the tree in the rest pose, world coordinates.
struct RestLimb {
  glm::dvec3 from{0};  ///< the limb's joint in the tree
  glm::dvec3 to{0};    ///< the limb's far end, which defines its Z axis
  std::vector<glm::dvec3> tips;
  Role leads_to = kHipCentre;  ///< the first role along the limb, away from the pelvis
};

/// Builds the tree from the parts: up the left leg to the pelvis, then outwards from there.
class Builder {
 public:
  explicit Builder(const Parts& parts) : parts_(parts), limb_of_(parts.size(), -1) {}

  Result<CaptureBody> Build() {
    // Add the left leg, from the toe to the pelvis. The tree runs up this leg, so a limb's parent in the rest body is
    // its child in the tree.
    AddRoot();
    int below = -1;
    for (int part = parts_.CarrierOf(kLeftFoot); part >= 0; part = parts_[part].parent) {
      RETURN_IF_ERROR(AddLeftLegLimb(part, below));
      below = part;
    }
    // Add all other parts, parents first.
    for (std::size_t limb = 1; limb < order_.size(); ++limb) {  // order_ grows inside the loop
      for (const int child : parts_.ChildrenOf(order_[limb])) {
        if (limb_of_[child] < 0) RETURN_IF_ERROR(AddOutwardLimb(child));
      }
    }
    // Add the roles, twists and end effectors that pictures show, and the skeleton that `ToClip` writes.
    PlaceRoles();
    AddTwists();
    AddEnds();
    AddSkeleton();
    return std::move(body_);
  }

 private:
  void AddRoot() {
    body_.tree.joints.push_back({.name = "left_toe"});
    order_.push_back(-1);
    rest_axes_.push_back(glm::dmat3(1));
  }

  // Adds the limb for `part`, which is the pelvis or a part of the left leg. The limb begins at the end of limb
  // `below`.
  Result<void> AddLeftLegLimb(int part, int below) {
    RestLimb limb;
    limb.from = below < 0 ? parts_.places()[kLeftFoot] : parts_[below].at;
    limb.tips = parts_.TipsOf(part);
    if (part == parts_.pelvis()) {
      limb.to = parts_.places()[kRightHip];
    } else {
      limb.to = parts_[part].at;
      limb.tips.push_back(limb.to);
    }
    return Add(part, below < 0 ? 0 : limb_of_[below], limb);
  }

  // Adds a limb that leads away from the pelvis; the limb's far end is the part's farthest tip.
  Result<void> AddOutwardLimb(int part) {
    RestLimb limb{.from = parts_[part].at, .to = parts_[part].at, .tips = parts_.TipsOf(part)};
    for (const glm::dvec3& tip : limb.tips) {
      if (glm::distance(tip, limb.from) > glm::distance(limb.to, limb.from)) limb.to = tip;
    }
    limb.leads_to = FirstRoleBelow(part);
    return Add(part, limb_of_[parts_[part].parent], limb);
  }

  Role FirstRoleBelow(int part) const {
    std::vector<int> next{part};
    for (std::size_t i = 0; i < next.size(); ++i) {
      for (const Role role : AllRoles()) {
        if (parts_.CarrierOf(role) == next[i]) return role;
      }
      const std::vector<int> children = parts_.ChildrenOf(next[i]);
      next.insert(next.end(), children.begin(), children.end());
    }
    return kHipCentre;  // unreachable: Simplify leaves out parts without a role
  }

  Result<void> Add(int part, int parent, const RestLimb& limb) {
    if (!(glm::distance(limb.from, limb.to) > kMinLimbLengthM)) {
      return Fail({}, "the limb '{}' of the body at rest has no length", parts_[part].name);
    }
    // If the parent turns about the same point, attach the limb to the first ancestor that turns about another point.
    while (parent > 0 && AreSame(OriginOf(parent), limb.from)) parent = body_.tree.joints[parent].parent;
    // Compute the limb's axes in the rest pose and the limb's axes when all angles are zero.
    TreeJoint joint{.name = {}, .parent = parent};
    const glm::dmat3 R_WL = RestAxes(part, limb);
    joint.p_PJ = glm::transpose(rest_axes_[parent]) * (limb.from - OriginOf(parent));
    joint.R_PJ = glm::transpose(rest_axes_[parent]) * NeutralAxes(limb, R_WL);
    joint.first_dof = body_.tree.dof_count();
    joint.dof_count = DofsOf(part, limb);
    // Limit the angles only if pictures do not show the joint.
    const double max_angle = IsHidden(part, limb.from) ? kMaxHiddenAngle : kUnlimited;
    for (int dof = 0; dof < joint.dof_count; ++dof) body_.tree.limits.push_back({-max_angle, max_angle});
    limb_of_[part] = static_cast<int>(body_.tree.joints.size());
    body_.tree.joints.push_back(joint);
    order_.push_back(part);
    rest_axes_.push_back(R_WL);
    origins_.push_back(limb.from);
    return {};
  }

  glm::dvec3 OriginOf(int limb) const { return limb == 0 ? parts_.places()[kLeftFoot] : origins_[limb - 1]; }

  // Returns R_WL at rest. Z runs along the limb. X points forward for the pelvis, along the axis of the elbow for arms,
  // and to the right for the other limbs.
  glm::dmat3 RestAxes(int part, const RestLimb& limb) const {
    const glm::dvec3 z = glm::normalize(limb.to - limb.from);
    const glm::dvec3 wanted = part == parts_.pelvis() ? kAhead
                              : IsArm(limb.leads_to)  ? glm::cross(z, kAhead)
                                                      : kToTheRight;
    glm::dvec3 x = wanted - glm::dot(wanted, z) * z;
    // If `wanted` is nearly parallel to Z, take the forward axis instead; if both are nearly parallel to Z, the
    // downward axis.
    constexpr double kAlong = 0.1;
    if (glm::length(x) < kAlong) x = kAhead - glm::dot(kAhead, z) * z;
    if (glm::length(x) < kAlong) x = kDownwards - glm::dot(kDownwards, z) * z;
    x = glm::normalize(x);
    return {x, glm::cross(z, x), z};
  }

  // Returns the limb's axes when its angles are zero. Euler angles are singular where a limb points along ±X. An
  // upper arm's X axis is therefore diagonal. The two singular directions are then forward-outward and backward-inward
  // (behind the trunk). Arms point there less often than down, sideways or forward.
  glm::dmat3 NeutralAxes(const RestLimb& limb, const glm::dmat3& R_WL) const {
    if (limb.leads_to != kLeftElbow && limb.leads_to != kRightElbow) return R_WL;
    const double back = limb.leads_to == kLeftElbow ? -1 : 1;
    const glm::dvec3 x = glm::normalize(kToTheRight + back * kAhead);
    return {x, glm::cross(kDownwards, x), kDownwards};
  }

  // Returns the limb's number of degrees of freedom: 3 if its rotation about its own axis is visible, else 2.
  int DofsOf(int part, const RestLimb& limb) const {
    const bool is_branched = parts_.ChildrenOf(part).size() > 1 || part == parts_.pelvis();
    const glm::dvec3 z = glm::normalize(limb.to - limb.from);
    const bool is_line = std::ranges::all_of(
        limb.tips, [&](const glm::dvec3& tip) { return glm::length(glm::cross(tip - limb.from, z)) < kMaxOffLineM; });
    const bool is_climbed_shank = AreSame(limb.from, parts_.places()[kLeftAnkle]);
    const bool bends_below = limb.leads_to == kLeftElbow || limb.leads_to == kRightElbow || limb.leads_to == kRightKnee;
    return is_branched || !is_line || is_climbed_shank || bends_below ? 3 : 2;
  }

  // Returns true if the joint at `from` coincides with no role, so that pictures do not show how it bends.
  bool IsHidden(int part, const glm::dvec3& from) const {
    if (part == parts_.pelvis()) return false;
    return std::ranges::none_of(parts_.places().joints, [&](const glm::dvec3& place) { return AreSame(place, from); });
  }

  // Returns a position of the rest pose as a point of the limb made from `part`.
  TreePoint PointAt(const glm::dvec3& place, int part) const {
    const int limb = limb_of_[part];
    return {limb, glm::transpose(rest_axes_[limb]) * (place - OriginOf(limb))};
  }

  // Returns true if `place` is the joint or a tip of the part.
  bool Holds(int part, const glm::dvec3& place) const {
    if (AreSame(parts_[part].at, place)) return true;
    return std::ranges::any_of(parts_.TipsOf(part), [&](const glm::dvec3& tip) { return AreSame(tip, place); });
  }

  void PlaceRoles() {
    for (const Role role : AllRoles()) {
      body_.roles[Index(role)] = PointAt(parts_.places()[role], parts_.CarrierOf(role));
      const auto parent = ParentOf(role);
      if (!parent) continue;
      const glm::dvec3& upper = parts_.places()[*parent];
      body_.bones[Index(role)] = glm::distance(parts_.places()[role], upper);
      body_.is_rigid[Index(role)] = Holds(parts_.CarrierOf(role), upper);
    }
    body_.hips_turn = parts_.CarrierOf(kLeftHip) != parts_.pelvis() || parts_.CarrierOf(kRightHip) != parts_.pelvis();
    const BodyPose rest = parts_.places();
    body_.lengths = MeasureLimbLengths(std::span(&rest, 1));
  }

  // Adds the limbs whose twist turns the plane in which an elbow or a knee bends.
  void AddTwists() {
    const auto add = [&](Role lower_joint, Role upper, Role middle, Role lower, double bends) {
      const TreePoint& point = body_.roles[Index(lower_joint)];
      body_.twists.push_back({point.joint, upper, middle, lower, bends});
    };
    add(kLeftElbow, kLeftShoulder, kLeftElbow, kLeftWrist, 1);
    add(kRightElbow, kRightShoulder, kRightElbow, kRightWrist, 1);
    add(kRightKnee, kRightHip, kRightKnee, kRightAnkle, -1);
    add(kLeftAnkle, kLeftHip, kLeftKnee, kLeftAnkle, -1);
  }

  // Adds paper B's four end effectors. The left foot needs no target position, because the root is put at its observed
  // position; only the direction of the foot's limb is a target.
  void AddEnds() {
    for (const Role role : {kRightFoot, kLeftHand, kRightHand, kHead}) AddEnd(role, true);
    AddEnd(kLeftFoot, false);
  }

  void AddEnd(Role role, bool has_position) {
    const glm::dvec3 outer = parts_.places()[role], inner = parts_.places()[*ParentOf(role)];
    const int limb = limb_of_[parts_.CarrierOf(role)];
    // A limb of the left leg begins at the joint nearer to the toe and ends at the joint nearer to the pelvis.
    const bool is_climbed = AreSame(OriginOf(limb), outer);
    const TreePoint end = PointAt(is_climbed ? inner : outer, parts_.CarrierOf(role));
    // A direction is a target only if the stroke between the two roles runs along the rigid limb itself.
    const double off_line = glm::length(glm::cross(end.p_LQ, glm::dvec3(0, 0, 1)));
    const bool has_direction =
        AreSame(OriginOf(limb), is_climbed ? outer : inner) && body_.is_rigid[Index(role)] && off_line < kMaxOffLineM;
    if (!has_position && !has_direction) return;
    body_.tree.effectors.push_back({RoleName(role), limb, end.p_LQ});
    body_.ends.push_back({role, has_position, has_direction, is_climbed ? -1.0 : 1.0});
  }

  void AddSkeleton() {
    // Make one skeleton joint per part, parents first, from the pelvis outwards.
    std::vector<int> joint_of(parts_.size(), -1);
    std::vector<int> next{parts_.pelvis()};
    for (std::size_t i = 0; i < next.size(); ++i) {
      const int part = next[i];
      const int limb = limb_of_[part];
      joint_of[part] = static_cast<int>(body_.skeleton.size());
      const bool is_root = part == parts_.pelvis();
      body_.skeleton.push_back({.name = parts_[part].name,
                                .parent = is_root ? -1 : joint_of[parts_[part].parent],
                                .offset = is_root ? glm::dvec3(0) : parts_[part].at - parts_[parts_[part].parent].at,
                                .limb = limb,
                                .R_LC = glm::transpose(rest_axes_[limb])});
      const std::vector<int> children = parts_.ChildrenOf(part);
      next.insert(next.end(), children.begin(), children.end());
    }
    // Add the five ends of the body as end sites.
    body_.skeleton_root = PointAt(parts_[parts_.pelvis()].at, parts_.pelvis());
    for (const Role role : {kHead, kLeftHand, kRightHand, kLeftFoot, kRightFoot}) {
      const int part = parts_.CarrierOf(role);
      body_.skeleton.push_back({.name = std::string(RoleName(role)) + "_end",
                                .parent = joint_of[part],
                                .offset = parts_.places()[role] - parts_[part].at,
                                .limb = limb_of_[part],
                                .R_LC = glm::transpose(rest_axes_[limb_of_[part]]),
                                .is_end = true});
    }
  }

  const Parts& parts_;
  CaptureBody body_;
  std::vector<int> limb_of_;           // for each part: its limb, or −1 while it has none
  std::vector<int> order_;             // for each limb: its part
  std::vector<glm::dmat3> rest_axes_;  // for each limb: R_WL at rest
  std::vector<glm::dvec3> origins_;    // the rest position of each limb's joint, except the first limb's
};

}  // namespace

Result<CaptureBody> FittedBody(const RestBody& rest) {
  Parts parts(rest);
  if (!parts.AreConnected()) return Fail({}, "a part of the body is not connected to the pelvis");
  parts.Simplify();
  return Builder(parts).Build();
}

}  // namespace etude
