#include "engine/retargeting/opensim_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/base/angles.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/joint_limits.h"
#include "engine/motion/clip.h"
#include "engine/retargeting/rig.h"

namespace etude {
namespace {

using enum Role;

/// Where an angle's range stands among those of `MakeBodyTree`, and whether it is counted the other way there.
struct TreeAngle {
  BodyTreeJoint joint;
  int axis = 0;
  bool is_reversed = false;
};

/// An angle of a part: its name without the side, and the range of the right side.
struct PartAngle {
  std::string_view name;
  std::optional<TreeAngle> range = {};
};

/// The turning part that ends at `end`: the right one of two, whose left one mirrors it.
struct Part {
  Role end;
  std::array<PartAngle, 3> angles;  ///< about Z, X and Y
  double z_sign = 1;                ///< −1 of knees, which bend backwards
};

// Parents stand before children, as in AllRoles.
const std::array<Part, 12> kParts = {{
    {kHipCentre, {{{"pelvis_tilt"}, {"pelvis_list"}, {"pelvis_rotation"}}}},
    {kSpine, {{{"abdomen_extension"}, {"abdomen_bending"}, {"abdomen_rotation"}}}},
    {kShoulderCentre,
     {{{"lumbar_extension", TreeAngle{kTreeNavel, 0}},
       {"lumbar_bending", TreeAngle{kTreeNavel, 1}},
       {"lumbar_rotation", TreeAngle{kTreeNavel, 2}}}}},
    {kHead,
     {{{"neck_extension", TreeAngle{kTreeNeck, 0}},
       {"neck_bending", TreeAngle{kTreeNeck, 1}},
       {"neck_rotation", TreeAngle{kTreeNeck, 2}}}}},
    {kRightShoulder, {{{"clavicle_flex"}, {"clavicle_add"}, {"clavicle_rot"}}}},
    {kRightElbow,
     {{{"arm_flex", TreeAngle{kTreeRightShoulder, 0}},
       {"arm_add", TreeAngle{kTreeRightShoulder, 1, true}},
       {"arm_rot", TreeAngle{kTreeRightShoulder, 2, true}}}}},
    {kRightWrist, {{{"elbow_flex", TreeAngle{kTreeRightElbow, 0}}, {"elbow_add"}, {"pro_sup"}}}},
    {kRightHand, {{{"wrist_flex", TreeAngle{kTreeRightWrist, 0}}, {"wrist_dev"}, {"wrist_rot"}}}},
    {kRightHip, {{{"girdle_flex"}, {"girdle_add"}, {"girdle_rot"}}}},
    {kRightKnee,
     {{{"hip_flexion", TreeAngle{kTreeRightHip, 0}},
       {"hip_adduction", TreeAngle{kTreeRightHip, 1, true}},
       {"hip_rotation", TreeAngle{kTreeRightHip, 2, true}}}}},
    {kRightAnkle, {{{"knee_angle", TreeAngle{kTreeRightKnee, 0, true}}, {"knee_adduction"}, {"knee_rotation"}}}, -1},
    {kRightFoot,
     {{{"ankle_angle", TreeAngle{kTreeRightAnkle, 0}},
       {"ankle_inversion", TreeAngle{kTreeRightAnkle, 1, true}},
       {"ankle_rotation"}}}},
}};

/// A part of either side, as it is written.
struct WrittenPart {
  Role end;
  std::array<std::string, 3> names;
  std::array<std::optional<AngleRange>, 3> limits;  ///< radians
  glm::dvec3 signs{1};                              ///< of the turns about Z, X and Y
};

std::optional<AngleRange> RangeOf(const PartAngle& angle, const KinematicTree& tree) {
  if (!angle.range) return std::nullopt;
  const AngleRange range = tree.limits[tree.joints[angle.range->joint].first_dof + angle.range->axis];
  return angle.range->is_reversed ? AngleRange{-range.upper, -range.lower} : range;
}

std::vector<WrittenPart> WrittenParts() {
  const KinematicTree tree = MakeBodyTree({});
  std::vector<WrittenPart> parts;
  for (const Role role : AllRoles()) {
    const auto is_it = [&](const Part& one) { return one.end == role || Mirrored(one.end) == role; };
    const Part& part = *std::ranges::find_if(kParts, is_it);
    const bool is_left = part.end != role, is_paired = Mirrored(role) != role;
    WrittenPart written{
        .end = role, .names = {}, .limits = {}, .signs = {part.z_sign, is_left ? -1 : 1, is_left ? -1 : 1}};
    for (std::size_t i = 0; i < 3; ++i) {
      written.names[i] = std::string(part.angles[i].name) + (is_left ? "_l" : is_paired ? "_r" : "");
      written.limits[i] = RangeOf(part.angles[i], tree);
    }
    parts.push_back(std::move(written));
  }
  return parts;
}

/// Etude's axes (X to the left, Y up, Z forward) as OpenSim's (X forward, Y up, Z to the right).
glm::dvec3 InOpenSim(const glm::dvec3& v) { return {v.z, v.y, -v.x}; }

glm::dmat3 InOpenSim(const glm::dmat3& turn) {
  // Column j: where the axis j goes, whose direction in our axes is the inverse of the above.
  return {InOpenSim(turn * glm::dvec3(0, 0, 1)), InOpenSim(turn * glm::dvec3(0, 1, 0)),
          InOpenSim(turn * glm::dvec3(-1, 0, 0))};
}

double Unwrapped(double angle, double near) { return angle - 2 * kPi * std::round((angle - near) / (2 * kPi)); }

/// The turns a, b, c of R = Rz(a) Rx(b) Ry(c), of all triples that nearest to `before`.
glm::dvec3 TurnsOf(const glm::dmat3& R, const glm::dvec3& before) {
  const auto at = [&](int row, int column) { return R[column][row]; };
  constexpr double kLocked = 1e-9;
  const double b = std::asin(std::clamp(at(2, 1), -1.0, 1.0));
  double a = std::atan2(-at(0, 1), at(1, 1)), c = std::atan2(-at(2, 0), at(2, 2));
  if (std::hypot(at(0, 1), at(1, 1)) < kLocked) {  // only the sum or the difference of the outer two shows
    c = before.z;
    a = std::atan2(at(1, 0), at(0, 0)) - (b > 0 ? c : -c);
  }
  const auto near = [&](double x, double y, double z) {
    return glm::dvec3(Unwrapped(x, before.x), Unwrapped(y, before.y), Unwrapped(z, before.z));
  };
  const glm::dvec3 one = near(a, b, c), other = near(a + kPi, kPi - b, c + kPi);
  return glm::distance(one, before) <= glm::distance(other, before) ? one : other;
}

/// Each part's turn in the world since the rest pose, by the role at its end.
std::array<glm::dmat3, kRoleCount> PartTurns(const BodyPose& pose, const BodyPose& rest, const Clip& rig,
                                             const LocalPose& frame) {
  std::vector<GlobalTransform> joints;
  ComputeGlobals(rig.skeleton, frame, joints);
  std::array<glm::dmat3, kRoleCount> turns;
  turns[Index(kHipCentre)] = joints[Index(kHipCentre)].axes;
  for (const Bone& bone : AllBones()) {
    // The rig's joint carries its limb, but for those that share one: they go on by the shortest way.
    const glm::dmat3& axes = joints[Index(bone.parent)].axes;
    const glm::dvec3 carried = axes * (rest[bone.child] - rest[bone.parent]);
    turns[Index(bone.child)] = glm::mat3_cast(ShortestTurn(carried, pose[bone.child] - pose[bone.parent])) * axes;
  }
  return turns;
}

std::string HeadOf(const BodyMotion& motion, const std::vector<WrittenPart>& parts, const BodyPose& rest,
                   std::string name) {
  std::ranges::replace_if(
      name, [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }, '_');
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "Coordinates\nversion=1\nnRows={}\nnColumns={}\ninDegrees=yes\n\n", motion.poses.size(),
                 1 + 3 + 3 * parts.size());
  fmt::format_to(out, "Motion {}, angles of the model below; metres, X forward, Y up, Z to the right\n", name);
  for (const WrittenPart& part : parts) {
    const auto parent = ParentOf(part.end);
    const glm::dvec3 bone = parent ? InOpenSim(rest[part.end] - rest[*parent]) : glm::dvec3(0);
    fmt::format_to(out, "part {} after {} bone {:.9g} {:.9g} {:.9g} turns", RoleName(part.end),
                   parent ? RoleName(*parent) : "ground", bone.x, bone.y, bone.z);
    for (int i = 0; i < 3; ++i) fmt::format_to(out, " {}{} {}", part.signs[i] < 0 ? '-' : '+', "ZXY"[i], part.names[i]);
    text += '\n';
  }
  for (const WrittenPart& part : parts) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!part.limits[i]) continue;
      fmt::format_to(out, "limit {} {:g} {:g}\n", part.names[i], Degrees(part.limits[i]->lower),
                     Degrees(part.limits[i]->upper));
    }
  }
  text += "\nendheader\ntime";
  for (const WrittenPart& part : parts) {
    for (const std::string& angle : part.names) text += "\t" + angle;
    if (part.end == kHipCentre) text += "\tpelvis_tx\tpelvis_ty\tpelvis_tz";
  }
  return text + "\n";
}

}  // namespace

std::string WriteOpenSimMotion(const BodyMotion& motion, const BodyPose& rest, std::string name) {
  const std::vector<WrittenPart> parts = WrittenParts();
  const Clip rig = RigClip(motion, rest, name);
  std::string text = HeadOf(motion, parts, rest, std::move(name));
  const auto out = std::back_inserter(text);
  std::array<glm::dvec3, kRoleCount> before{};
  for (std::size_t f = 0; f < motion.poses.size(); ++f) {
    const BodyPose& pose = motion.poses[f];
    const auto turns = PartTurns(pose, rest, rig, rig.frames[f]);
    fmt::format_to(out, "{:.6f}", static_cast<double>(f) / motion.rate_hz);
    for (const WrittenPart& part : parts) {
      const auto parent = ParentOf(part.end);
      const glm::dmat3 above = parent ? turns[Index(*parent)] : glm::dmat3(1);
      glm::dvec3& angles = before[Index(part.end)];
      angles = TurnsOf(InOpenSim(glm::transpose(above) * turns[Index(part.end)]), angles);
      for (int i = 0; i < 3; ++i) fmt::format_to(out, "\t{:.6f}", Degrees(part.signs[i] * angles[i]));
      if (parent) continue;
      const glm::dvec3 place = InOpenSim(pose[part.end]);
      fmt::format_to(out, "\t{:.6f}\t{:.6f}\t{:.6f}", place.x, place.y, place.z);
    }
    text += '\n';
  }
  return text;
}

}  // namespace etude
