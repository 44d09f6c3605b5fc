#include "engine/retargeting/body_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>
#include <vector>

#include "engine/base/names.h"
#include "engine/retargeting/map_file.h"

namespace etude {
namespace {

constexpr std::size_t kMinBodyJoints = 12, kMaxBodies = 8;

/// A body, and its joints: those with roles and those between them.
struct FoundBody {
  JointMap map;
  std::vector<int> joints;  ///< ascending; the first is the ancestor of all others
};

/// Finds the joints of a body. They are empty if the joints with roles have no common ancestor.
FoundBody FoundBodyOf(const Skeleton& skeleton, JointMap map) {
  std::vector<int> below(skeleton.joints.size());
  int wanted = 0;
  for (const Role role : AllRoles()) {
    if (map[role].joint < 0) continue;
    ++wanted;
    for (int joint = map[role].joint; joint >= 0; joint = skeleton.joints[joint].parent) ++below[joint];
  }
  // The deepest ancestor of all joints with roles comes last, because parents come before their children.
  const int top = static_cast<int>(std::ranges::find(below | std::views::reverse, wanted).base() - below.begin()) - 1;
  FoundBody body{std::move(map), {}};
  for (int joint = top; top >= 0 && joint < static_cast<int>(below.size()); ++joint) {
    if (below[joint] > 0) body.joints.push_back(joint);
  }
  return body;
}

/// A part of a clip's skeleton, with a few frames.
struct Remainder {
  Skeleton skeleton;
  std::vector<int> joint_in_clip;
  std::vector<LocalPose> frames;
};

/// Returns the joints of a clip that are not below the tops of the bodies.
Remainder RemainderOf(const Clip& clip, const std::vector<FoundBody>& bodies) {
  constexpr std::size_t kFrames = 15;
  Remainder others;
  std::vector<int> place(clip.skeleton.joints.size(), -1);
  for (int i = 0; i < static_cast<int>(place.size()); ++i) {
    const int parent = clip.skeleton.joints[i].parent;
    const bool is_top = std::ranges::any_of(bodies, [&](const FoundBody& body) { return body.joints.front() == i; });
    if (is_top || (parent >= 0 && place[parent] < 0)) continue;
    place[i] = static_cast<int>(others.joint_in_clip.size());
    others.joint_in_clip.push_back(i);
    Joint& joint = others.skeleton.joints.emplace_back(clip.skeleton.joints[i]);
    joint.parent = parent < 0 ? -1 : place[parent];
    // Readers add numbers to equal names ("Hips#2"), so restore the file's own names.
    joint.name = joint.name.substr(0, joint.name.rfind('#'));
  }
  const std::size_t count = std::min(kFrames, clip.frames.size());
  for (std::size_t k = 0; k < count; ++k) {
    LocalPose& frame = others.frames.emplace_back();
    for (const int joint : others.joint_in_clip) frame.push_back(clip.frames[k * clip.frames.size() / count][joint]);
  }
  return others;
}

/// Finds up to kMaxBodies bodies; `first` is the first of them.
std::vector<FoundBody> FindBodies(const Clip& clip, JointMap first) {
  std::vector<FoundBody> bodies = {FoundBodyOf(clip.skeleton, std::move(first))};
  while (!bodies.back().joints.empty() && bodies.size() < kMaxBodies) {
    const Remainder others = RemainderOf(clip, bodies);
    if (others.skeleton.joints.size() < kMinBodyJoints) break;
    auto next = FindJointMap(others.skeleton, "", nullptr, others.frames);
    if (!next) break;
    for (RolePoint& point : next->points) {
      if (point.joint >= 0) point.joint = others.joint_in_clip[point.joint];
    }
    bodies.push_back(FoundBodyOf(clip.skeleton, *std::move(next)));
  }
  if (bodies.back().joints.empty() && bodies.size() > 1) bodies.pop_back();
  return bodies;
}

bool IsMoved(const Clip& clip, const FoundBody& body) {
  constexpr double kHalfTurnCosine = 0.99999048;  // cosine of 0.25°: a turn of 0.5°
  constexpr double kSlideOfThigh = 0.01;
  std::vector<GlobalTransform> globals;
  ComputeGlobals(clip.skeleton, clip.frames.front(), globals);
  const BodyPose pose = Evaluate(body.map, globals);
  const double slide = kSlideOfThigh * glm::distance(pose[Role::kLeftHip], pose[Role::kLeftKnee]);
  return std::ranges::any_of(body.joints, [&](int joint) {
    const LocalTransform& first = clip.frames.front()[joint];
    return std::ranges::any_of(clip.frames, [&](const LocalPose& frame) {
      const double cosine = std::abs(glm::dot(frame[joint].rotation, first.rotation));  // of half the turn
      return cosine < kHalfTurnCosine || glm::distance(frame[joint].translation, first.translation) > slide;
    });
  });
}

std::string LeftHipOf(const Clip& clip, const FoundBody& body) {
  return Quote(clip.skeleton.joints[static_cast<std::size_t>(body.map[Role::kLeftHip].joint)].name);
}

}  // namespace

Result<BodyChoice> ChooseBody(const Clip& clip, const std::string& file, const JointMapOverrides* taught,
                              const std::set<std::string>& skinned) {
  ASSIGN_OR_RETURN(auto first, FindJointMap(clip.skeleton, file, taught, clip.frames));
  std::vector<FoundBody> bodies = FindBodies(clip, std::move(first));
  if (bodies.size() == 1) return BodyChoice{std::move(bodies.front().map)};
  const auto rank = [&](const FoundBody& body) {
    const bool is_skinned = std::ranges::all_of(body.map.points, [&](const RolePoint& point) {
      return point.joint < 0 || skinned.contains(clip.skeleton.joints[static_cast<std::size_t>(point.joint)].name);
    });
    return std::pair(!clip.frames.empty() && IsMoved(clip, body), is_skinned);
  };
  const bool is_taught = taught != nullptr && !taught->joints.empty();
  const auto used = is_taught ? bodies.begin() : std::ranges::max_element(bodies, {}, rank);
  std::vector<std::string> left_out;
  for (auto body = bodies.begin(); body != bodies.end(); ++body) {
    if (body != used) left_out.push_back(LeftHipOf(clip, *body));
  }
  const std::string others =
      left_out.size() == 1 ? "a second body with the left hip " + left_out.front()
                           : fmt::format("{} other bodies with the left hips {}", left_out.size(), Join(left_out));
  std::string doubt =
      fmt::format("the file contains {}; Etude uses the body with {} (use --joint-map to choose another body)", others,
                  LeftHipOf(clip, *used));
  return BodyChoice{std::move(used->map), std::move(doubt)};
}

}  // namespace etude
