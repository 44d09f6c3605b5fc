#include "engine/motion/edit.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/base/nearest_rotation.h"
#include "engine/base/text.h"
#include "engine/motion/clip.h"

namespace etude {
namespace {

struct SideWord {
  std::string_view from, to;
};
// Longer words come first because "left" also begins with "l".
constexpr std::array<SideWord, 10> kSideWords = {{
    {"left", "right"},
    {"Left", "Right"},
    {"LEFT", "RIGHT"},
    {"right", "left"},
    {"Right", "Left"},
    {"RIGHT", "LEFT"},
    {"l", "r"},
    {"L", "R"},
    {"r", "l"},
    {"R", "L"},
}};

bool IsLetter(char c) { return IsLower(c) || IsUpper(c); }

/// Returns the index after the namespace, such as "mixamorig:" in "mixamorig:LeftArm".
std::size_t StartOfName(std::string_view name) { return name.find_last_of(':') + 1; }

/// Returns the index after the word that begins at `at` (marked by | in "Left|Arm", "l|Shldr", "L|Thigh",
/// "upper|_arm").
std::size_t EndOfWord(std::string_view name, std::size_t at) {
  std::size_t end = at + 1;
  for (; end < name.size() && IsLetter(name[end]); ++end) {
    const bool capital_after_small = IsLower(name[end - 1]) && IsUpper(name[end]);
    const bool last_of_capitals =
        IsUpper(name[end - 1]) && IsUpper(name[end]) && end + 1 < name.size() && IsLower(name[end + 1]);
    if (capital_after_small || last_of_capitals) break;
  }
  return end;
}

std::string Replaced(std::string_view name, std::size_t at, const SideWord& turn) {
  return std::string(name.substr(0, at)).append(turn.to).append(name.substr(at + turn.from.size()));
}

/// If the name may begin with a side and no word boundary follows ("lfemur"), returns its possible names on the other
/// side, the most likely first.
std::vector<std::string> IfGlued(std::string_view name) {
  std::vector<std::string> others;
  const std::size_t start = StartOfName(name);
  for (const SideWord& turn : kSideWords) {
    if (name.substr(start).starts_with(turn.from)) others.push_back(Replaced(name, start, turn));
  }
  return others;
}

constexpr glm::dquat kNoTurn{1, 0, 0, 0};

/// Replaces a transform T by its mirror image M T M, M = diag(−1, 1, 1).
void Reflect(LocalTransform& local) {
  local.translation.x = -local.translation.x;
  local.rotation.y = -local.rotation.y;
  local.rotation.z = -local.rotation.z;
}

bool HasScales(const LocalPose& pose) {
  return std::ranges::any_of(pose, [](const LocalTransform& local) { return local.scale != glm::dvec3(1); });
}

/// Returns the rotation nearest to a matrix, or nullopt if the matrix mirrors or is nearly singular.
std::optional<glm::dquat> RotationOf(const glm::dmat3& axes) {
  const double size = std::sqrt(glm::dot(axes[0], axes[0]) + glm::dot(axes[1], axes[1]) + glm::dot(axes[2], axes[2]));
  constexpr double kFlat = 1e-9;
  if (!(glm::determinant(axes) > kFlat * size * size * size)) return std::nullopt;
  return glm::normalize(glm::quat_cast(NearestRotationTo(axes).rotation));
}

/// Converts poses of a skeleton to poses whose scales are 1.
class ScaleRemover {
 public:
  explicit ScaleRemover(const Skeleton& skeleton) : skeleton_(skeleton), rotations_(skeleton.joints.size()) {}

  void Apply(LocalPose& pose) {
    ComputeGlobals(skeleton_, pose, globals_);
    for (std::size_t i = 0; i < pose.size(); ++i) {
      const int parent = skeleton_.joints[i].parent;
      const glm::dquat above = parent < 0 ? kNoTurn : rotations_[parent];
      const glm::dvec3 origin = parent < 0 ? glm::dvec3(0) : globals_[parent].position;
      rotations_[i] = RotationOf(globals_[i].axes).value_or(above * pose[i].rotation);
      pose[i] = {.translation = glm::conjugate(above) * (globals_[i].position - origin),
                 .rotation = glm::normalize(glm::conjugate(above) * rotations_[i])};
    }
  }

 private:
  const Skeleton& skeleton_;
  std::vector<GlobalTransform> globals_;
  std::vector<glm::dquat> rotations_;  ///< rotations of the joints in the world
};

void SetRest(Skeleton& skeleton, const LocalPose& rest) {
  for (std::size_t i = 0; i < rest.size(); ++i) skeleton.joints[i].rest = rest[i];
}

std::string UnusedName(const Skeleton& skeleton, std::string name) {
  while (skeleton.Find(name) >= 0) name += '_';
  return name;
}

}  // namespace

std::string OtherSide(std::string_view name) {
  for (std::size_t at = StartOfName(name); at < name.size();) {
    if (!IsLetter(name[at])) {
      ++at;
      continue;
    }
    const std::size_t end = EndOfWord(name, at);
    const std::string_view word = name.substr(at, end - at);
    const bool is_numbered = word.size() == 1 && end < name.size() && IsDigit(name[end]);  // such as the vertebra "L5"
    for (const SideWord& turn : kSideWords) {
      if (word == turn.from && !is_numbered) return Replaced(name, at, turn);
    }
    at = end;
  }
  return std::string(name);
}

Skeleton WithSidesSwapped(Skeleton skeleton) {
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints) {
    std::string& name = names.emplace_back(OtherSide(joint.name));
    if (name != joint.name) continue;
    for (std::string& other : IfGlued(joint.name)) {
      if (skeleton.Find(other) < 0) continue;
      name = std::move(other);
      break;
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i) skeleton.joints[i].name = std::move(names[i]);
  return skeleton;
}

Clip Resample(const Clip& clip, double rate_hz) {
  assert(rate_hz > 0 && !clip.frames.empty());
  if (rate_hz == clip.rate_hz) return clip;
  Clip resampled{.name = clip.name, .skeleton = clip.skeleton, .rate_hz = rate_hz, .frames = {}};
  const double frames_per_sample = clip.rate_hz / rate_hz;
  constexpr double kRounding = 1e-6;  // in samples; keeps the last sample if one rate is a multiple of the other
  const auto count = static_cast<std::size_t>(clip.DurationSeconds() * rate_hz + kRounding) + 1;
  resampled.frames.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    resampled.frames.push_back(SampleFrame(clip, static_cast<double>(k) * frames_per_sample));
  }
  return resampled;
}

Result<Clip> Trim(const Clip& clip, double from_s, double to_s) {
  const double first = std::round(from_s * clip.rate_hz);
  const double last = std::round(to_s * clip.rate_hz);
  const bool is_within = first >= 0 && last < static_cast<double>(clip.frames.size());
  if (!(is_within && from_s <= to_s)) {
    return Fail({}, "cannot keep the range {} s to {} s; allowed: a range within the clip, which lasts {:.6g} s",
                from_s, to_s, clip.DurationSeconds());
  }
  const auto begin = clip.frames.begin();
  return Clip{.name = clip.name,
              .skeleton = clip.skeleton,
              .rate_hz = clip.rate_hz,
              .frames = {begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(last) + 1}};
}

Clip Mirror(Clip clip) {
  for (Joint& joint : clip.skeleton.joints) Reflect(joint.rest);
  for (LocalPose& pose : clip.frames) std::ranges::for_each(pose, Reflect);
  clip.skeleton = WithSidesSwapped(std::move(clip.skeleton));
  return clip;
}

BodyMotion Mirror(const BodyMotion& motion) {
  BodyMotion mirrored{.rate_hz = motion.rate_hz, .poses = {}};
  mirrored.poses.reserve(motion.poses.size());
  for (const BodyPose& pose : motion.poses) {
    BodyPose& image = mirrored.poses.emplace_back();
    for (const Role role : AllRoles()) image[Mirrored(role)] = glm::dvec3(-1, 1, 1) * pose[role];
  }
  return mirrored;
}

Clip WithoutScales(Clip clip) {
  LocalPose rest = RestPose(clip.skeleton);
  if (!HasScales(rest) && std::ranges::none_of(clip.frames, HasScales)) return clip;
  ScaleRemover remover(clip.skeleton);
  remover.Apply(rest);
  for (LocalPose& pose : clip.frames) remover.Apply(pose);
  SetRest(clip.skeleton, rest);
  return clip;
}

Clip WithWorldAxesAtRest(Clip clip) {
  std::vector<Joint>& joints = clip.skeleton.joints;
  if (std::ranges::all_of(joints, [](const Joint& joint) { return joint.rest.rotation == kNoTurn; })) return clip;
  // A joint's new coordinate frame is its old frame rotated by R₀⁻¹, where R₀ are the joint's axes at rest in the
  // world.
  std::vector<glm::dquat> at_rest(joints.size());
  const auto above = [&](std::size_t joint) {
    return joints[joint].parent < 0 ? kNoTurn : at_rest[joints[joint].parent];
  };
  for (std::size_t i = 0; i < joints.size(); ++i) {
    at_rest[i] = glm::normalize(above(i) * joints[i].rest.rotation);
    joints[i].rest = {.translation = above(i) * joints[i].rest.translation};
  }
  for (LocalPose& pose : clip.frames) {
    for (std::size_t i = 0; i < pose.size(); ++i) {
      assert(pose[i].scale == glm::dvec3(1));
      pose[i].translation = above(i) * pose[i].translation;
      pose[i].rotation = above(i) * pose[i].rotation * glm::conjugate(at_rest[i]);
    }
  }
  return clip;
}

Clip WithOneRoot(Clip clip) {
  std::vector<Joint>& joints = clip.skeleton.joints;
  if (std::ranges::count(joints, -1, &Joint::parent) == 1) return clip;
  // The new root gets index 0, so every index increases by one, and the parent −1 becomes the new root.
  for (Joint& joint : joints) ++joint.parent;
  joints.insert(joints.begin(), {.name = UnusedName(clip.skeleton, "root"), .parent = -1, .rest = {}});
  for (LocalPose& pose : clip.frames) pose.insert(pose.begin(), LocalTransform{});
  return clip;
}

Clip WithRootAt(const Clip& clip, int joint) {
  const std::vector<Joint>& old = clip.skeleton.joints;
  // Reverse the path from the new root to the old root.
  std::vector<int> parents;
  for (const Joint& one : old) parents.push_back(one.parent);
  for (int child = joint, parent = old[joint].parent; parent >= 0;) {
    const int next = old[parent].parent;
    parents[parent] = child;
    child = std::exchange(parent, next);
  }
  parents[joint] = -1;
  // Order the joints so that parents come first. A joint follows as soon as its parent has an index; otherwise the old
  // order is kept.
  std::vector<int> order, place(old.size(), -1);
  while (order.size() < old.size()) {
    for (int i = 0; i < static_cast<int>(old.size()); ++i) {
      if (place[i] >= 0 || (parents[i] >= 0 && place[parents[i]] < 0)) continue;
      place[i] = static_cast<int>(order.size());
      order.push_back(i);
    }
  }
  Clip rooted{.name = clip.name, .skeleton = {}, .rate_hz = clip.rate_hz, .frames = {}};
  std::vector<GlobalTransform> globals;
  // Convert a pose: a joint that keeps its parent keeps its transform. The transforms of the other joints are computed
  // from poses in the world.
  const auto in_order = [&](const LocalPose& pose) {
    ComputeGlobals(clip.skeleton, pose, globals);
    LocalPose moved;
    for (const int i : order) {
      const bool is_root = parents[i] < 0;
      const GlobalTransform parent = is_root ? GlobalTransform{} : globals[parents[i]];
      if (!is_root && parents[i] == old[i].parent) {
        moved.push_back(pose[i]);
        continue;
      }
      const glm::dmat3 back = glm::transpose(parent.axes);
      moved.push_back({.translation = back * (globals[i].position - parent.position),
                       .rotation = glm::normalize(glm::quat_cast(back * globals[i].axes))});
    }
    return moved;
  };
  // Build the skeleton and convert every frame.
  const LocalPose rest = in_order(RestPose(clip.skeleton));
  for (std::size_t k = 0; k < order.size(); ++k) {
    const int parent = parents[order[k]];
    rooted.skeleton.joints.push_back({.name = old[order[k]].name,
                                      .parent = parent < 0 ? -1 : place[parent],
                                      .rest = rest[k],
                                      .is_end_site = old[order[k]].is_end_site});
  }
  for (const LocalPose& frame : clip.frames) rooted.frames.push_back(in_order(frame));
  return rooted;
}

}  // namespace etude
