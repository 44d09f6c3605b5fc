#include "engine/retargeting/joint_map.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/names.h"
#include "engine/retargeting/anatomy.h"
#include "engine/retargeting/limb_finder.h"
#include "engine/retargeting/map_file.h"
#include "engine/retargeting/tips.h"

namespace etude {
namespace {

using enum Role;

/// Lists up to sixty of the file's joint names, for error messages.
std::string NamesSeen(const Skeleton& skeleton) {
  constexpr std::size_t kShownNames = 60;
  std::vector<std::string> seen;
  for (const Joint& joint : skeleton.joints) {
    if (!joint.is_end_site && seen.size() < kShownNames) seen.push_back(Quote(joint.name));
  }
  return "joints in the file: " + Join(seen);
}

class MapFinder {
 public:
  /// `rest` serves as the rest pose; `moving` holds poses of the clip.
  MapFinder(const Skeleton& skeleton, const std::string& file, const LocalPose& rest, const MovingPoses& moving)
      : skeleton_(skeleton), file_(file), tree_(skeleton, rest), names_(skeleton), draft_(tree_), moving_(moving) {}

  Result<JointMap> Find(const JointMapOverrides* taught) {
    if (taught != nullptr) {
      RETURN_IF_ERROR(AssignTaught(*taught));
    }
    RETURN_IF_ERROR(FindLimbs());
    RETURN_IF_ERROR(FindPelvis());
    FindNeckAndHead();
    FindSpine();
    RETURN_IF_ERROR(CheckTree());
    RETURN_IF_ERROR(CheckSides());
    FindTips(draft_, is_taught_, moving_);
    JointMap map = draft_.map();
    map.by_anatomy = by_anatomy_;
    map.confidence = confidence_;
    return map;
  }

 private:
  Result<void> AssignTaught(const JointMapOverrides& taught) {
    for (const auto& [role, joint] : taught.joints) {
      const int found = skeleton_.Find(joint.name);
      if (found < 0) {
        std::vector<std::string> names;
        for (const Joint& known : skeleton_.joints) names.push_back(known.name);
        const std::string nearest = NearestName(joint.name, names);
        return Fail(joint.place, "{} has no joint named {}{}; {}", file_, Quote(joint.name),
                    nearest.empty() ? "" : "; did you mean " + Quote(nearest) + "?", NamesSeen(skeleton_));
      }
      draft_.Set(role, found);
      is_taught_[Index(role)] = true;
    }
    return {};
  }

  Result<void> FindLimbs() {
    // Find the joints of every limb by name.
    std::vector<std::string> missing;
    std::vector<Role> missing_roles;
    for (const Limb& limb : kLimbs) {
      const std::array<int, 3> taught = {draft_.JointOf(limb.roles[0]), draft_.JointOf(limb.roles[1]),
                                         draft_.JointOf(limb.roles[2])};
      const FoundLimb found = FindLimb(names_, tree_, limb.is_arm ? ArmSchemes() : LegSchemes(), limb.side, taught);
      if (prefix_.empty()) prefix_ = found.prefix;
      for (std::size_t i = 0; i < 3; ++i) {
        if (found.joints[i] >= 0) {
          draft_.Set(limb.roles[i], found.joints[i]);
          continue;
        }
        missing_roles.push_back(limb.roles[i]);
        missing.emplace_back(RoleName(limb.roles[i]));
        // If other joints of a naming scheme were found, suggest the scheme's name for the missing joint.
        if (found.scheme != nullptr) missing.back() += fmt::format(" (a '{}')", found.scheme->joints[i]);
      }
    }
    if (missing.empty()) return {};
    // Take the missing joints from the proposal by shape, if the proposal agrees with the names and is confident
    // enough.
    const AnatomyProposal proposal = ProposeByAnatomy(tree_);
    const bool agrees = std::ranges::all_of(AllRoles(), [&](Role role) {
      return proposal.joints[Index(role)] < 0 || !draft_.Has(role) ||
             draft_.JointOf(role) == proposal.joints[Index(role)];
    });
    if (agrees && proposal.confidence >= kMinAnatomyConfidence) {
      for (const Role role : missing_roles) draft_.Set(role, proposal.joints[Index(role)]);
      by_anatomy_ = std::move(missing_roles);
      confidence_ = proposal.confidence;
      return {};
    }
    // Otherwise fail, with the proposal in the message.
    std::string guess;
    if (agrees && proposal.confidence > 0) {
      guess = fmt::format(
          "by the skeleton's shape, the role {} could be the joint {} (confidence {:.2f}; Etude needs at least "
          "{:.1f}); `etude clip map` writes a joint map with this proposal, which you can edit; ",
          RoleName(missing_roles[0]), Quote(tree_.NameOf(proposal.joints[Index(missing_roles[0])])),
          proposal.confidence, kMinAnatomyConfidence);
    }
    return Fail({file_}, "no joint found for {}; {}{}", Join(missing), guess, NamesSeen(skeleton_));
  }

  Result<void> FindPelvis() {
    if (draft_.Has(kHipCentre)) return {};
    const int pelvis = tree_.CommonAncestor(draft_.JointOf(kLeftHip), draft_.JointOf(kRightHip));
    if (pelvis < 0) {
      return Fail({file_}, "the hips, {} and {}, have no common ancestor", Quote(draft_.NameOf(kLeftHip)),
                  Quote(draft_.NameOf(kRightHip)));
    }
    draft_.Set(kHipCentre, pelvis);
    return {};
  }

  /// Returns the first joint that has one of these names and for which `fits` is true; prefers joints with the limbs'
  /// prefix. Returns −1 without such a joint.
  template <typename Fits>
  int FindInMiddle(std::span<const std::string_view> role_names, Fits fits) const {
    for (const std::string_view name : role_names) {
      std::vector<NamedJoint> candidates = names_.Find(name);
      std::stable_partition(candidates.begin(), candidates.end(),
                            [&](const NamedJoint& named) { return named.prefix == prefix_; });
      const auto first = std::ranges::find_if(candidates, fits, &NamedJoint::joint);
      if (first != candidates.end()) return first->joint;
    }
    return -1;
  }

  void FindNeckAndHead() {
    const auto is_above_pelvis = [&](int joint) { return tree_.DescendsFrom(joint, draft_.JointOf(kHipCentre)); };
    int head = FindInMiddle(HeadNames(), is_above_pelvis);
    if (head < 0) head = HeadByShape();
    if (!draft_.Has(kHead) && head >= 0) draft_.Set(kHead, head);
    if (draft_.Has(kShoulderCentre)) return;
    // CMU's "Neck" coincides with its parent, a chest joint; CMU's "Neck1" is at the base of the neck. The threshold is
    // a share of a limb's length, because limb lengths do not depend on the rest pose.
    const double tiny = 0.01 * glm::distance(draft_.RestOf(kLeftShoulder), draft_.RestOf(kLeftElbow));
    const int neck = FindInMiddle(NeckNames(), [&](int joint) {
      return is_above_pelvis(joint) && (head < 0 || tree_.DescendsFrom(head, joint)) &&
             glm::distance(tree_.RestOf(joint), tree_.RestOf(tree_.ParentOf(joint))) > tiny;
    });
    if (neck >= 0) return draft_.Set(kShoulderCentre, neck);
    const int carrier = tree_.CommonAncestor(draft_.JointOf(kLeftShoulder), draft_.JointOf(kRightShoulder));
    draft_.Compose(kShoulderCentre, std::max(carrier, 0),
                   0.5 * (draft_.RestOf(kLeftShoulder) + draft_.RestOf(kRightShoulder)));
  }

  /// Finds the highest joint that belongs to no limb and lies 0.15 to 0.8 trunk lengths beyond the shoulders in the
  /// direction of the trunk. If that joint is an end site whose parent is not an ancestor of the shoulders, returns the
  /// parent; otherwise returns the joint. Returns −1 without such a joint.
  int HeadByShape() const {
    const int carrier = tree_.CommonAncestor(draft_.JointOf(kLeftShoulder), draft_.JointOf(kRightShoulder));
    const glm::dvec3 neck = 0.5 * (draft_.RestOf(kLeftShoulder) + draft_.RestOf(kRightShoulder));
    const glm::dvec3 trunk = neck - 0.5 * (draft_.RestOf(kLeftHip) + draft_.RestOf(kRightHip));
    constexpr double kMinHeight = 0.15, kMaxHeight = 0.8, kAside = Radians(30);
    double highest = kMinHeight;
    int head = -1;
    // Keep the highest joint that passes the tests of height and direction and belongs to no limb.
    for (int joint = std::max(carrier, 0) + 1; carrier >= 0 && joint < tree_.size(); ++joint) {
      const glm::dvec3 on = tree_.RestOf(joint) - neck;
      const double height = glm::dot(on, trunk) / glm::dot(trunk, trunk);
      const auto is_of_limb = [&](const Limb& limb) {
        const int top = draft_.JointOf(limb.roles[0]);
        return joint == top || tree_.DescendsFrom(joint, top);
      };
      if (!(height > highest && height <= kMaxHeight) || AngleBetween(on, trunk) > kAside) continue;
      if (!tree_.DescendsFrom(joint, carrier) || std::ranges::any_of(kLimbs, is_of_limb)) continue;
      highest = height;
      head = joint;
    }
    const bool is_end = head >= 0 && tree_.IsEnd(head) && tree_.ParentOf(head) != carrier;
    return is_end ? tree_.ParentOf(head) : head;
  }

  /// Assigns the spine: the joint nearest to the middle of the chain from the pelvis to the base of the neck.
  void FindSpine() {
    if (draft_.Has(kSpine)) return;
    // Measure distances along the chain. Unlike straight distances, these do not depend on the rest pose; in some files
    // the body is curled up at rest.
    const int pelvis = draft_.JointOf(kHipCentre);
    const int neck = draft_.JointOf(kShoulderCentre);
    std::vector<int> chain;
    std::vector<double> from_neck;
    double way = 0;
    glm::dvec3 last = draft_.RestOf(kShoulderCentre);
    for (int joint = draft_.IsComposed(kShoulderCentre) ? neck : tree_.ParentOf(neck); joint >= pelvis;
         joint = tree_.ParentOf(joint)) {
      way += glm::distance(last, tree_.RestOf(joint));
      last = tree_.RestOf(joint);
      chain.push_back(joint);
      from_neck.push_back(way);
    }
    double nearest = way;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const double distance = std::abs(from_neck[i] - 0.5 * way);
      if (chain[i] == pelvis || distance >= nearest) continue;
      nearest = distance;
      draft_.Set(kSpine, chain[i]);
    }
    if (!draft_.Has(kSpine))
      draft_.Compose(kSpine, pelvis, 0.5 * (draft_.RestOf(kShoulderCentre) + draft_.RestOf(kHipCentre)));
  }

  Result<void> CheckDescends(Role child, Role parent) const {
    if (tree_.DescendsFrom(draft_.JointOf(child), draft_.JointOf(parent))) return {};
    return Fail({file_}, "the role {} has the joint {}, which does not descend from {}, the joint of the role {}",
                RoleName(child), Quote(draft_.NameOf(child)), Quote(draft_.NameOf(parent)), RoleName(parent));
  }

  Result<void> CheckTree() const {
    std::vector<Bone> pairs;
    if (is_taught_[Index(kSpine)]) pairs.push_back({kHipCentre, kSpine});
    if (!draft_.IsComposed(kShoulderCentre)) pairs.push_back({kHipCentre, kShoulderCentre});
    if (!draft_.IsComposed(kShoulderCentre) && draft_.Has(kHead)) pairs.push_back({kShoulderCentre, kHead});
    for (const Limb& limb : kLimbs) {
      pairs.push_back({kHipCentre, limb.roles[0]});
      pairs.push_back({limb.roles[0], limb.roles[1]});
      if (!IsFree(draft_, limb.roles[2])) pairs.push_back({limb.roles[1], limb.roles[2]});
      if (is_taught_[Index(limb.tip)]) pairs.push_back({limb.roles[2], limb.tip});
    }
    if (is_taught_[Index(kHead)]) pairs.push_back({kHipCentre, kHead});
    for (const Bone& pair : pairs) {
      RETURN_IF_ERROR(CheckDescends(pair.child, pair.parent));
    }
    for (const Role role : {kSpine, kShoulderCentre, kHead}) {
      if (IsFree(draft_, role)) continue;
      return Fail(
          {file_},
          "the role {} has the joint {}, which is part of a limb; allowed: a joint of the trunk, the neck or the head",
          RoleName(role), Quote(draft_.NameOf(role)));
    }
    return {};
  }

  Result<void> CheckSides() const {
    const glm::dvec3 across = draft_.RestOf(kLeftHip) - draft_.RestOf(kRightHip);
    const double left = glm::dot(draft_.RestOf(kLeftHip) - draft_.RestOf(kHipCentre), across);
    const double right = glm::dot(draft_.RestOf(kRightHip) - draft_.RestOf(kHipCentre), across);
    if (left > 0 && right < 0) return {};
    return Fail({file_},
                "the hips {} and {} are on the same side of {} in the rest pose; allowed: one hip on each side",
                Quote(draft_.NameOf(kLeftHip)), Quote(draft_.NameOf(kRightHip)), Quote(draft_.NameOf(kHipCentre)));
  }

  const Skeleton& skeleton_;
  const std::string& file_;
  const SkeletonTree tree_;
  const JointNames names_;
  std::string prefix_;  ///< common prefix of the limbs' names
  std::vector<Role> by_anatomy_;
  double confidence_ = 1;
  std::array<bool, kRoleCount> is_taught_{};
  JointMapDraft draft_;
  const MovingPoses& moving_;
};

/// Returns how upright a pose is: the cosine of the largest angle between a thigh or shank and the line from shoulders
/// to hips. Returns nullopt unless all joints of arms and legs are found by name.
std::optional<double> StandingOf(const Skeleton& skeleton, const JointNames& names, const LocalPose& pose) {
  const SkeletonTree tree(skeleton, pose);
  std::array<glm::dvec3, kRoleCount> at{};
  for (const Limb& limb : kLimbs) {
    const FoundLimb found =
        FindLimb(names, tree, limb.is_arm ? ArmSchemes() : LegSchemes(), limb.side, {-1, -1, -1});
    for (std::size_t i = 0; i < 3; ++i) {
      if (found.joints[i] < 0) return std::nullopt;
      at[Index(limb.roles[i])] = tree.RestOf(found.joints[i]);
    }
  }
  const auto of = [&](Role role) { return at[Index(role)]; };
  const glm::dvec3 down =
      UnitOr(of(kLeftHip) + of(kRightHip) - of(kLeftShoulder) - of(kRightShoulder), glm::dvec3(0));
  double worst = 1;
  for (const Limb& limb : kLegs) {
    const auto [hip, knee, ankle] = limb.roles;
    worst = std::min({worst, glm::dot(UnitOr(of(knee) - of(hip), glm::dvec3(0)), down),
                      glm::dot(UnitOr(of(ankle) - of(knee), glm::dvec3(0)), down)});
  }
  return worst;
}

/// Returns a few frames, evenly spaced.
std::vector<const LocalPose*> SomeOf(std::span<const LocalPose> frames, const Skeleton& skeleton) {
  constexpr std::size_t kPoses = 15;
  std::vector<const LocalPose*> some;
  for (std::size_t i = 0; i < std::min(kPoses, frames.size()); ++i) {
    const LocalPose& frame = frames[i * frames.size() / std::min(kPoses, frames.size())];
    if (frame.size() == skeleton.joints.size()) some.push_back(&frame);
  }
  return some;
}

/// Returns the rest pose if it is a human pose, otherwise the most upright frame.
LocalPose RestOrStanding(const Skeleton& skeleton, const std::vector<const LocalPose*>& frames) {
  constexpr double kPose = 0.5;  // cosine: legs within 60° of the trunk's line
  LocalPose rest = RestPose(skeleton);
  if (frames.empty()) return rest;
  const JointNames names(skeleton);
  const auto at_rest = StandingOf(skeleton, names, rest);
  if (!at_rest || *at_rest > kPose) return rest;
  double best = std::max(*at_rest, kPose);
  for (const LocalPose* frame : frames) {
    const auto standing = StandingOf(skeleton, names, *frame);
    if (!standing || *standing <= best) continue;
    best = *standing;
    rest = *frame;
  }
  return rest;
}

}  // namespace

Result<JointMap> FindJointMap(const Skeleton& skeleton, const std::string& file, const JointMapOverrides* taught,
                              std::span<const LocalPose> frames) {
  const std::vector<const LocalPose*> some = SomeOf(frames, skeleton);
  MovingPoses moving;
  for (const LocalPose* frame : some) ComputeGlobals(skeleton, *frame, moving.emplace_back());
  const auto is_finite = [](const GlobalTransform& joint) {
    return std::isfinite(glm::dot(joint.position, joint.position)) && std::isfinite(glm::determinant(joint.axes));
  };
  std::erase_if(moving, [&](const auto& joints) { return !std::ranges::all_of(joints, is_finite); });
  return MapFinder(skeleton, file, RestOrStanding(skeleton, some), moving).Find(taught);
}

PartialRoles FindPartialRoles(const Skeleton& skeleton) {
  const SkeletonTree tree(skeleton);
  const JointNames names(skeleton);
  PartialRoles roles;
  roles.found.fill(-1);
  roles.proposed.fill(-1);
  for (const Limb& limb : kLimbs) {
    const FoundLimb found = FindLimb(names, tree, limb.is_arm ? ArmSchemes() : LegSchemes(), limb.side, {-1, -1, -1});
    for (std::size_t i = 0; i < 3; ++i) roles.found[Index(limb.roles[i])] = found.joints[i];
  }
  for (const auto& [role, role_names] : {std::pair(kShoulderCentre, NeckNames()), std::pair(kHead, HeadNames())}) {
    for (const std::string_view name : role_names) {
      const std::vector<NamedJoint> found = names.Find(name);
      if (roles.found[Index(role)] < 0 && !found.empty()) roles.found[Index(role)] = found.front().joint;
    }
  }
  const AnatomyProposal proposal = ProposeByAnatomy(tree);
  roles.confidence = proposal.confidence;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    if (roles.found[i] < 0) roles.proposed[i] = proposal.joints[i];
  }
  return roles;
}

int FindNewRoot(const Skeleton& skeleton) {
  const SkeletonTree tree(skeleton);
  const JointNames names(skeleton);
  std::array<int, 4> tops{};
  for (std::size_t i = 0; i < kLimbs.size(); ++i) {
    tops[i] =
        FindLimb(names, tree, kLimbs[i].is_arm ? ArmSchemes() : LegSchemes(), kLimbs[i].side, {-1, -1, -1}).joints[0];
    if (tops[i] < 0) return -1;
  }
  const int chest = tree.CommonAncestor(tops[0], tops[1]), pelvis = tree.CommonAncestor(tops[2], tops[3]);
  return chest >= 0 && pelvis >= 0 && tree.DescendsFrom(pelvis, chest) ? pelvis : -1;
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
