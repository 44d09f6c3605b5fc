#include "engine/silhouettes/silhouette_body.h"

#include <cassert>
#include <string_view>

#include "engine/base/angles.h"
#include "engine/kinematics/limb_lengths.h"

namespace etude {
namespace {

using enum Role;

enum JointIndex {
  kPelvis,
  kLoins,
  kChest,
  kNeck,
  kLeftCollar,
  kLeftUpperArm,
  kLeftForearm,
  kLeftPalm,
  kRightCollar,
  kRightUpperArm,
  kRightForearm,
  kRightPalm,
  kLeftThigh,
  kLeftShank,
  kLeftSole,
  kRightThigh,
  kRightShank,
  kRightSole,
  kJointCount
};

enum Part { kTrunk, kHeadAndNeck, kArms, kHands, kLegs, kFeet, kPartCount };

// Axes of limbs in the world, for a body that stands at rest and faces +Z. The columns of the matrices are a limb's X,
// Y and Z axes.
const glm::dvec3 kRight(-1, 0, 0), kUp(0, 1, 0), kForward(0, 0, 1);
const glm::dmat3 kRising(kRight, kForward, kUp);
const glm::dmat3 kHanging(kRight, -kForward, -kUp);
const glm::dmat3 kToTheLeft(-kForward, kUp, -kRight);
const glm::dmat3 kToTheRight(kForward, kUp, kRight);
const glm::dmat3 kFootwards(kRight, -kUp, kForward);

using AngleHabit = SilhouetteBody::Habit;

// A joint of the tree: its position, and the limb that rotates about the joint. Limits are in degrees, one range for
// each degree of freedom: X bends forward and back, Y moves the limb sideways, Z rotates it about its own axis. The
// limits of joint_limits.h are widened to what people really reach, so every pose in a picture is allowed.
struct JointRow {
  JointIndex self;
  std::string_view name;
  int parent;
  Role at;
  glm::dmat3 R_WJ;
  std::vector<AngleRange> limits_deg;
  std::vector<AngleHabit> habits_deg;
};

const std::array<JointRow, kJointCount>& JointRows() {
  static const std::array<JointRow, kJointCount> rows = {{
      // Columns: joint, name, parent, position, axes at rest, limits, usual angles with standard deviations.
      {kPelvis, "pelvis", -1, kHipCentre, kRising, {}, {}},
      {kLoins, "loins", kPelvis, kHipCentre, kRising, {{-60, 30}, {-35, 35}, {-45, 45}}, {{0, 20}, {0, 12}, {0, 15}}},
      {kChest, "chest", kLoins, kSpine, kRising, {{-45, 25}, {-25, 25}, {-35, 35}}, {{0, 15}, {0, 10}, {0, 12}}},
      {kNeck, "neck", kChest, kShoulderCentre, kRising, {{-60, 60}, {-45, 45}, {-70, 70}}, {{0, 20}, {0, 15}, {0, 25}}},
      // The arms.
      {kLeftCollar, "left_collar", kChest, kShoulderCentre, kToTheLeft, {{-12, 35}, {-25, 25}}, {{0, 10}, {0, 10}}},
      {kLeftUpperArm,
       "left_upper_arm",
       kLeftCollar,
       kLeftShoulder,
       kHanging,
       {{-90, 190}, {-88, 60}, {-110, 110}},
       {{20, 60}, {0, 45}, {0, 45}}},
      {kLeftForearm, "left_forearm", kLeftUpperArm, kLeftElbow, kHanging, {{0, 150}}, {{40, 45}}},
      {kLeftPalm, "left_hand", kLeftForearm, kLeftWrist, kHanging, {{-60, 60}, {-30, 30}}, {{0, 20}, {0, 12}}},
      {kRightCollar, "right_collar", kChest, kShoulderCentre, kToTheRight, {{-12, 35}, {-25, 25}}, {{0, 10}, {0, 10}}},
      {kRightUpperArm,
       "right_upper_arm",
       kRightCollar,
       kRightShoulder,
       kHanging,
       {{-90, 190}, {-60, 88}, {-110, 110}},
       {{20, 60}, {0, 45}, {0, 45}}},
      {kRightForearm, "right_forearm", kRightUpperArm, kRightElbow, kHanging, {{0, 150}}, {{40, 45}}},
      {kRightPalm, "right_hand", kRightForearm, kRightWrist, kHanging, {{-60, 60}, {-30, 30}}, {{0, 20}, {0, 12}}},
      // The legs.
      {kLeftThigh,
       "left_thigh",
       kPelvis,
       kLeftHip,
       kHanging,
       {{-40, 130}, {-70, 40}, {-60, 60}},
       {{15, 40}, {0, 25}, {0, 20}}},
      {kLeftShank, "left_shank", kLeftThigh, kLeftKnee, kHanging, {{-150, 0}}, {{-20, 40}}},
      {kLeftSole, "left_foot", kLeftShank, kLeftAnkle, kFootwards, {{-65, 35}, {-30, 30}}, {{-15, 20}, {0, 10}}},
      {kRightThigh,
       "right_thigh",
       kPelvis,
       kRightHip,
       kHanging,
       {{-40, 130}, {-40, 70}, {-60, 60}},
       {{15, 40}, {0, 25}, {0, 20}}},
      {kRightShank, "right_shank", kRightThigh, kRightKnee, kHanging, {{-150, 0}}, {{-20, 40}}},
      {kRightSole, "right_foot", kRightShank, kRightAnkle, kFootwards, {{-65, 35}, {-30, 30}}, {{-15, 20}, {0, 10}}},
  }};
  return rows;
}

// For each joint of the canonical body, in the order of Role: the limb to which the joint is fixed.
constexpr std::array<JointIndex, kRoleCount> kCarriers = {
    kPelvis,   kChest,         kNeck,         kNeck,       kLeftUpperArm, kLeftForearm, kLeftPalm,
    kLeftPalm, kRightUpperArm, kRightForearm, kRightPalm,  kRightPalm,    kLeftThigh,   kLeftShank,
    kLeftSole, kLeftSole,      kRightThigh,   kRightShank, kRightSole,    kRightSole};

// Constant lengths and offsets in this file describe a person of 1.70 m. kStatureLengths is the sum of that person's
// thigh, shank and trunk.
constexpr double kStatureLengths = 1.32;  // metres
constexpr double kShoulderFall = 0.025;   // metres; height of the base of the neck above the shoulders

// Returns the standing pose at rest with the hip centre at the origin.
BodyPose RestPose(const LimbLengths& lengths, double scale) {
  BodyPose rest;
  const double fall = kShoulderFall * scale;
  rest[kHipCentre] = {0, 0, 0};
  rest[kSpine] = kSpineShare * lengths.trunk * kUp;
  rest[kShoulderCentre] = (lengths.trunk + fall) * kUp;
  rest[kHead] = (lengths.trunk + lengths.neck) * kUp;
  for (const double side : {+1.0, -1.0}) {
    const auto own = [&](Role left) { return side > 0 ? left : Mirrored(left); };
    const glm::dvec3 outward = -side * kRight;
    rest[own(kLeftShoulder)] = lengths.trunk * kUp + 0.5 * lengths.shoulder_width * outward;
    rest[own(kLeftElbow)] = rest[own(kLeftShoulder)] - lengths.upper_arm * kUp;
    rest[own(kLeftWrist)] = rest[own(kLeftElbow)] - lengths.forearm * kUp;
    rest[own(kLeftHand)] = rest[own(kLeftWrist)] - lengths.hand * kUp;
    rest[own(kLeftHip)] = 0.5 * lengths.hip_width * outward;
    rest[own(kLeftKnee)] = rest[own(kLeftHip)] - lengths.thigh * kUp;
    rest[own(kLeftAnkle)] = rest[own(kLeftKnee)] - lengths.shank * kUp;
    rest[own(kLeftFoot)] = rest[own(kLeftAnkle)] + lengths.foot * kForward;
  }
  return rest;
}

// Makes the tree of JointRows(); the offsets between joints are those in `rest`.
KinematicTree MakeTree(const BodyPose& rest) {
  KinematicTree tree;
  tree.standing_root = kRising;
  for (const JointRow& row : JointRows()) {
    TreeJoint joint{.name = row.name, .parent = row.parent};
    if (row.parent >= 0) {
      const JointRow& parent = JointRows()[row.parent];
      joint.p_PJ = glm::transpose(parent.R_WJ) * (rest[row.at] - rest[parent.at]);
      joint.R_PJ = glm::transpose(parent.R_WJ) * row.R_WJ;
    }
    joint.first_dof = tree.dof_count();
    joint.dof_count = static_cast<int>(row.limits_deg.size());
    tree.joints.push_back(joint);
    assert(row.habits_deg.size() == row.limits_deg.size());
    for (const AngleRange& range : row.limits_deg) tree.limits.push_back({Radians(range.lower), Radians(range.upper)});
  }
  return tree;
}

// A capsule on the left half or in the middle of the body; the right half's capsules mirror the left half's. Each end
// is a joint's position plus an offset in the standing body: centimetres to the left, up and forward, for a person of
// 1.70 m.
struct FleshRow {
  Part part;
  JointIndex limb;
  Role a;
  glm::dvec3 from_a_cm;
  Role b;
  glm::dvec3 from_b_cm;
  double radius_a_cm, radius_b_cm;
};

const std::vector<FleshRow>& FleshRows() {
  static const std::vector<FleshRow> rows = {
      // The pelvis and the chest are about 34 cm wide and 23 cm deep, the waist is 29 cm wide, and the crotch lies 8 cm
      // below the hip joints.
      {kTrunk, kPelvis, kHipCentre, {4, -1, 0}, kHipCentre, {5.5, 2, -1}, 7.5, 11.8},
      {kTrunk, kPelvis, kHipCentre, {5.5, 2, -1}, kHipCentre, {4.5, 9, 0}, 11.8, 11},
      {kTrunk, kLoins, kHipCentre, {4.2, 8, 0}, kSpine, {4.5, 0, 0}, 10.7, 10.7},
      {kTrunk, kChest, kSpine, {4.5, 0, 0}, kShoulderCentre, {5, -13, 0}, 10.8, 11},
      {kTrunk, kChest, kShoulderCentre, {2, -6, -1}, kShoulderCentre, {5, -13, 0}, 8, 10},
      {kTrunk, kLeftCollar, kShoulderCentre, {3, -3, -1}, kLeftShoulder, {-1, -0.5, 0}, 6, 5.8},
      {kHeadAndNeck, kNeck, kShoulderCentre, {0, 0, 0}, kShoulderCentre, {0, 12, 1.5}, 6, 5.8},
      {kHeadAndNeck, kNeck, kShoulderCentre, {0, 14, 2.5}, kShoulderCentre, {0, 19.5, 1}, 8.3, 9},
      {kArms, kLeftUpperArm, kLeftShoulder, {0, 0, 0}, kLeftElbow, {0, 0, 0}, 5.4, 4.2},
      {kArms, kLeftForearm, kLeftElbow, {0, 0, 0}, kLeftWrist, {0, 0, 0}, 4.3, 3},
      {kHands, kLeftPalm, kLeftWrist, {0, 0, 0}, kLeftHand, {0, 3, 0}, 3.2, 3},
      {kLegs, kLeftThigh, kLeftHip, {1, -2, 0}, kLeftKnee, {0, 0, 0}, 8.8, 5.8},
      {kLegs, kLeftShank, kLeftKnee, {0, 0, 0}, kLeftKnee, {0, -12, -1}, 5.6, 5.7},
      {kLegs, kLeftShank, kLeftKnee, {0, -12, -1}, kLeftAnkle, {0, 0, 0}, 5.7, 3.8},
      {kFeet, kLeftSole, kLeftAnkle, {0, -1, -3.5}, kLeftFoot, {0, 0, -3}, 4.5, 3.2},
  };
  return rows;
}

constexpr JointIndex MirroredLimb(JointIndex limb) {
  if (limb >= kLeftCollar && limb <= kLeftPalm) return static_cast<JointIndex>(limb + kRightCollar - kLeftCollar);
  if (limb >= kLeftThigh && limb <= kLeftSole) return static_cast<JointIndex>(limb + kRightThigh - kLeftThigh);
  return limb;
}

std::vector<FleshCapsule> MakeFlesh(const BodyPose& rest, double scale) {
  constexpr double kMetresPerCm = 0.01;
  const double unit = kMetresPerCm * scale;
  std::vector<FleshCapsule> flesh;
  for (const FleshRow& row : FleshRows()) {
    for (const bool mirror : {false, true}) {
      const bool in_the_middle =
          row.a == Mirrored(row.a) && row.b == Mirrored(row.b) && row.from_a_cm.x == 0 && row.from_b_cm.x == 0;
      if (mirror && in_the_middle) continue;
      const glm::dvec3 to_side(mirror ? -1 : 1, 1, 1);
      const JointIndex limb = mirror ? MirroredLimb(row.limb) : row.limb;
      const JointRow& joint = JointRows()[limb];
      const auto point = [&](Role role, const glm::dvec3& offset_cm) {
        const glm::dvec3 p_W = rest[mirror ? Mirrored(role) : role] + unit * to_side * offset_cm;
        return TreePoint{limb, glm::transpose(joint.R_WJ) * (p_W - rest[joint.at])};
      };
      flesh.push_back({point(row.a, row.from_a_cm), point(row.b, row.from_b_cm), unit * row.radius_a_cm,
                       unit * row.radius_b_cm, row.part});
    }
  }
  return flesh;
}

}  // namespace

SilhouetteBody MakeSilhouetteBody(const LimbLengths& lengths) {
  const double scale = (lengths.thigh + lengths.shank + lengths.trunk) / kStatureLengths;
  const BodyPose rest = RestPose(lengths, scale);
  SilhouetteBody body;
  body.tree = MakeTree(rest);
  for (const Role role : AllRoles()) {
    const JointRow& joint = JointRows()[kCarriers[Index(role)]];
    body.roles[Index(role)] = {joint.self, glm::transpose(joint.R_WJ) * (rest[role] - rest[joint.at])};
  }
  body.flesh = MakeFlesh(rest, scale);
  body.part_count = kPartCount;
  for (const JointRow& row : JointRows()) {
    for (const AngleHabit& habit : row.habits_deg) body.habits.push_back({Radians(habit.angle), Radians(habit.spread)});
  }
  body.limbs = {{kLeftUpperArm, kLeftForearm, true},
                {kRightUpperArm, kRightForearm, true},
                {kLeftThigh, kLeftShank, false},
                {kRightThigh, kRightShank, false}};
  return body;
}

glm::dvec3 PlaceOf(const TreePoint& point, const TreeFrames& frames) {
  const LimbFrame& X_WL = frames.joints[point.joint];
  return X_WL.position + X_WL.axes * point.p_LQ;
}

BodyPose ToBodyPose(const SilhouetteBody& body, const TreeFrames& frames) {
  BodyPose pose;
  for (std::size_t i = 0; i < kRoleCount; ++i) pose.joints[i] = PlaceOf(body.roles[i], frames);
  return pose;
}

BodyPose ToBodyPose(const SilhouetteBody& body, const TreeState& state) {
  return ToBodyPose(body, ComputeFrames(body.tree, state));
}

}  // namespace etude
