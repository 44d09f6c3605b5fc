#include "engine/kinematics/joint_limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "engine/base/angles.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/euler.h"

namespace etude {
namespace {

constexpr std::array<LimitSet, 4> kTable = {LimitSet::kAaos, LimitSet::kKendall, LimitSet::kHoppenfeld, LimitSet::kAma};

// Table 3.1 once more, typed from the paper; gaps filled from its first column. `right_axis`: about which axis of a
// body that stands facing +Z, its left at +X and its palms forward, the movement turns the part of the right limb that
// is farther from the trunk (right-hand rule).
struct TableRow {
  std::string_view movement;
  BodyTreeJoint right, left;
  glm::dvec3 right_axis;
  std::array<double, 4> degrees;
};
const glm::dvec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);
const std::vector<TableRow>& PairedRows() {
  static const std::vector<TableRow> rows = {
      {"shoulder flexion", kTreeRightShoulder, kTreeLeftShoulder, -kX, {180, 180, 90, 150}},
      {"shoulder extension", kTreeRightShoulder, kTreeLeftShoulder, kX, {60, 45, 45, 50}},
      {"shoulder abduction, of 180", kTreeRightShoulder, kTreeLeftShoulder, -kZ, {80, 80, 80, 80}},
      {"shoulder adduction, ours", kTreeRightShoulder, kTreeLeftShoulder, kZ, {30, 30, 30, 30}},
      {"shoulder inner rotation", kTreeRightShoulder, kTreeLeftShoulder, kY, {70, 70, 55, 90}},
      {"shoulder outer rotation", kTreeRightShoulder, kTreeLeftShoulder, -kY, {90, 90, 45, 90}},
      {"elbow flexion", kTreeRightElbow, kTreeLeftElbow, -kX, {150, 145, 150, 140}},
      {"elbow extension", kTreeRightElbow, kTreeLeftElbow, kX, {0, 0, 0, 0}},
      {"wrist flexion", kTreeRightWrist, kTreeLeftWrist, -kX, {80, 80, 80, 60}},
      {"wrist extension", kTreeRightWrist, kTreeLeftWrist, kX, {70, 70, 70, 60}},
      {"wrist radial deviation", kTreeRightWrist, kTreeLeftWrist, -kZ, {20, 20, 20, 20}},
      {"wrist ulnar deviation", kTreeRightWrist, kTreeLeftWrist, kZ, {30, 35, 30, 30}},
      {"hip flexion", kTreeRightHip, kTreeLeftHip, -kX, {120, 125, 135, 100}},
      {"hip extension", kTreeRightHip, kTreeLeftHip, kX, {30, 10, 30, 30}},
      {"hip abduction", kTreeRightHip, kTreeLeftHip, -kZ, {45, 45, 50, 40}},
      {"hip adduction", kTreeRightHip, kTreeLeftHip, kZ, {30, 10, 30, 20}},
      {"hip outer rotation", kTreeRightHip, kTreeLeftHip, -kY, {45, 45, 45, 40}},
      {"hip inner rotation", kTreeRightHip, kTreeLeftHip, kY, {45, 45, 35, 50}},
      {"knee flexion", kTreeRightKnee, kTreeLeftKnee, kX, {135, 140, 135, 150}},
      {"knee extension", kTreeRightKnee, kTreeLeftKnee, -kX, {0, 0, 0, 0}},
      {"dorsiflexion", kTreeRightAnkle, kTreeLeftAnkle, -kX, {20, 20, 20, 20}},
      {"plantarflexion", kTreeRightAnkle, kTreeLeftAnkle, kX, {50, 45, 50, 40}},
  };
  return rows;
}

// What only one joint of the tree can do; the trunk's upper part counts as the farther one.
const std::vector<TableRow>& SingleRows() {
  static const std::vector<TableRow> rows = {
      {"inversion", kTreeRightAnkle, kTreeRightAnkle, kY, {35, 35, 35, 30}},
      {"eversion", kTreeRightAnkle, kTreeRightAnkle, -kY, {15, 20, 15, 20}},
      {"neck flexion", kTreeNeck, kTreeNeck, kX, {45, 45, 45, 60}},
      {"neck extension", kTreeNeck, kTreeNeck, -kX, {45, 45, 45, 75}},
      {"neck to the right", kTreeNeck, kTreeNeck, kZ, {45, 45, 45, 45}},
      {"neck to the left", kTreeNeck, kTreeNeck, -kZ, {45, 45, 45, 45}},
      {"neck turns right", kTreeNeck, kTreeNeck, -kY, {60, 60, 60, 80}},
      {"neck turns left", kTreeNeck, kTreeNeck, kY, {60, 60, 60, 80}},
      {"trunk flexion", kTreeNavel, kTreeNavel, kX, {80, 80, 80, 50}},
      {"trunk extension", kTreeNavel, kTreeNavel, -kX, {25, 25, 25, 25}},
      {"trunk to the right", kTreeNavel, kTreeNavel, kZ, {35, 35, 35, 25}},
      {"trunk to the left", kTreeNavel, kTreeNavel, -kZ, {35, 35, 35, 25}},
      {"trunk turns right", kTreeNavel, kTreeNavel, -kY, {45, 45, 45, 30}},
      {"trunk turns left", kTreeNavel, kTreeNavel, kY, {45, 45, 45, 30}},
  };
  return rows;
}

bool IsClimbed(int joint) { return joint == kTreeLeftAnkle || joint == kTreeLeftKnee || joint == kTreeLeftHip; }

// How the part of the limb farther from the trunk has turned against the nearer one since the body stood at rest, seen
// from the nearer one.
glm::dmat3 TurnedBy(const KinematicTree& body, int joint, const std::vector<double>& angles) {
  const TreeFrames rest = ComputeFrames(body, StandingState(body));
  TreeState state = StandingState(body);
  state.angles = angles;
  const TreeFrames now = ComputeFrames(body, state);
  int nearer = body.joints[joint].parent, farther = joint;
  if (IsClimbed(joint)) std::swap(nearer, farther);
  const auto turn = [&](int limb) { return now.joints[limb].axes * glm::transpose(rest.joints[limb].axes); };
  return glm::transpose(turn(nearer)) * turn(farther);
}

// How far `limits` let one angle of `joint` turn about `axis`, degrees; empty when no angle of it does that.
std::optional<double> ReachAbout(int joint, const glm::dvec3& axis, const std::vector<AngleRange>& limits) {
  const KinematicTree body = MakeBodyTree({});
  for (int dof = body.joints[joint].first_dof, k = 0; k < body.joints[joint].dof_count; ++k, ++dof) {
    for (const bool rises : {false, true}) {
      const double end = rises ? limits[dof].upper : limits[dof].lower;
      const auto turned = [&](double angle) {
        std::vector<double> angles(limits.size(), 0.0);
        angles[dof] = angle;
        return TurnedBy(body, joint, angles);
      };
      const auto differs = [](const glm::dmat3& a, const glm::dmat3& b) {
        return std::max({glm::distance(a[0], b[0]), glm::distance(a[1], b[1]), glm::distance(a[2], b[2])}) > 1e-12;
      };
      if (differs(turned(rises ? 0.1 : -0.1), AxisRotation(axis, 0.1))) continue;
      EXPECT_FALSE(differs(turned(end), AxisRotation(axis, std::abs(end))));
      return Degrees(std::abs(end));
    }
  }
  return std::nullopt;
}

// A movement of the right limb, seen in a mirror between left and right.
glm::dvec3 Mirrored(const glm::dvec3& axis) { return {axis.x, -axis.y, -axis.z}; }

TEST(JointLimits, PosedBodiesMoveAsFarAsTheTableSaysOnBothSides) {
  int checked = 0;
  for (std::size_t column = 0; column < kTable.size(); ++column) {
    const std::vector<AngleRange> limits = JointLimits(kTable[column]);
    for (const auto* rows : {&PairedRows(), &SingleRows()}) {
      for (const TableRow& row : *rows) {
        SCOPED_TRACE(std::string(row.movement) + " in column " + std::to_string(column));
        const std::optional<double> right = ReachAbout(row.right, row.right_axis, limits);
        ASSERT_TRUE(right.has_value());
        EXPECT_NEAR(*right, row.degrees[column], 1e-9);
        if (row.left == row.right) continue;
        const std::optional<double> left = ReachAbout(row.left, Mirrored(row.right_axis), limits);
        ASSERT_TRUE(left.has_value());
        EXPECT_NEAR(*left, row.degrees[column], 1e-9);
        checked += 2;
      }
      checked += rows == &SingleRows() ? static_cast<int>(rows->size()) : 0;
    }
  }
  // Both ends of 29 angles in four columns: nothing of any set is left unchecked.
  EXPECT_EQ(checked, 2 * 29 * 4);
}

TEST(JointLimits, TheMirrorOfAMovementIsNotTheMovementItself) {
  const std::vector<AngleRange> limits = JointLimits(LimitSet::kAaos);
  EXPECT_NEAR(*ReachAbout(kTreeLeftHip, -kZ, limits), 30, 1e-9) << "what abducts the right thigh adducts the left one";
  EXPECT_FALSE(ReachAbout(kTreeLeftElbow, kZ, limits).has_value()) << "elbows do not bend sideways";
}

TEST(JointLimits, AreThoseOfTheTreeForAdults) {
  const std::vector<AngleRange> adult = JointLimits(LimitSet::kAdult);
  const KinematicTree body = MakeBodyTree({});
  ASSERT_EQ(adult.size(), body.limits.size());
  for (std::size_t i = 0; i < adult.size(); ++i) {
    EXPECT_EQ(adult[i].lower, body.limits[i].lower);
    EXPECT_EQ(adult[i].upper, body.limits[i].upper);
  }
}

TEST(JointLimits, OfAdultsExchangeTwoPairsOfMovements) {
  const std::vector<AngleRange> adult = JointLimits(LimitSet::kAdult);
  EXPECT_NEAR(*ReachAbout(kTreeRightHip, -kZ, adult), 45, 1e-9) << "abduction, as the table has it";
  EXPECT_NEAR(*ReachAbout(kTreeLeftHip, Mirrored(-kZ), adult), 30, 1e-9);
  EXPECT_NEAR(*ReachAbout(kTreeLeftHip, Mirrored(kZ), adult), 45, 1e-9);
  EXPECT_NEAR(*ReachAbout(kTreeRightWrist, -kZ, adult), 30, 1e-9) << "radial deviation, 20 in the table";
  EXPECT_NEAR(*ReachAbout(kTreeLeftWrist, Mirrored(-kZ), adult), 30, 1e-9);
}

TEST(JointLimits, LetTheBodyStand) {
  for (const std::string& name : LimitSetNames()) {
    for (const AngleRange& range : JointLimits(*FindLimitSet(name))) {
      EXPECT_LE(range.lower, 0) << name;
      EXPECT_GE(range.upper, 0) << name;
      EXPECT_LT(range.lower, range.upper) << name;
    }
  }
}

TEST(JointLimits, AreFoundByName) {
  EXPECT_EQ(FindLimitSet("adult"), LimitSet::kAdult);
  EXPECT_EQ(FindLimitSet("aaos"), LimitSet::kAaos);
  EXPECT_EQ(FindLimitSet("kendall"), LimitSet::kKendall);
  EXPECT_EQ(FindLimitSet("hoppenfeld"), LimitSet::kHoppenfeld);
  EXPECT_EQ(FindLimitSet("ama"), LimitSet::kAma);
  EXPECT_EQ(FindLimitSet("child"), std::nullopt);
}

}  // namespace
}  // namespace etude
