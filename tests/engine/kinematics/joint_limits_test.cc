#include "engine/kinematics/joint_limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "engine/base/angles.h"
#include "engine/base/euler.h"
#include "engine/kinematics/body_tree.h"

namespace etude {
namespace {

constexpr std::array<LimitSet, 5> kSets = {LimitSet::kAaos, LimitSet::kKendall, LimitSet::kHoppenfeld, LimitSet::kAma,
                                           LimitSet::kAdult};

// The direction in which a movement takes the outer part of a limb, relative to the inner part: the direction of the
// outer part's far end or, if the limb turns about its own axis, of its front. "Away" is away from the body's midline;
// for the trunk, it is to the left.
enum class Way { kForward, kBackward, kUp, kDown, kAway, kInwards, kFrontAway, kFrontInwards, kNowhere };
using enum Way;

// A second copy of table 3.1, typed from the paper. Values that a column of the table lacks are from its first column;
// after the table's four columns follows `adult`. `right_axis` is the axis (right-hand rule) about which the movement
// turns the right limb's outer part, for a body that faces +Z with palms forward.
struct TableRow {
  std::string_view movement;
  BodyTreeJoint right, left;
  glm::dvec3 right_axis;
  Way goes;
  std::array<double, kSets.size()> degrees;
};
const glm::dvec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);
const std::vector<TableRow>& PairedRows() {
  static const std::vector<TableRow> rows = {
      {"shoulder flexion", kTreeRightShoulder, kTreeLeftShoulder, -kX, kForward, {180, 180, 90, 150, 170}},
      {"shoulder extension", kTreeRightShoulder, kTreeLeftShoulder, kX, kBackward, {60, 45, 45, 50, 50}},
      {"shoulder abduction, of 180", kTreeRightShoulder, kTreeLeftShoulder, -kZ, kAway, {80, 80, 80, 80, 80}},
      {"shoulder adduction, ours", kTreeRightShoulder, kTreeLeftShoulder, kZ, kInwards, {30, 30, 30, 30, 30}},
      {"shoulder inner rotation", kTreeRightShoulder, kTreeLeftShoulder, kY, kFrontInwards, {70, 70, 55, 90, 70}},
      {"shoulder outer rotation", kTreeRightShoulder, kTreeLeftShoulder, -kY, kFrontAway, {90, 90, 45, 90, 70}},
      {"elbow flexion", kTreeRightElbow, kTreeLeftElbow, -kX, kForward, {150, 145, 150, 140, 145}},
      {"elbow extension", kTreeRightElbow, kTreeLeftElbow, kX, kBackward, {0, 0, 0, 0, 0}},
      {"wrist flexion", kTreeRightWrist, kTreeLeftWrist, -kX, kForward, {80, 80, 80, 60, 80}},
      {"wrist extension", kTreeRightWrist, kTreeLeftWrist, kX, kBackward, {70, 70, 70, 60, 70}},
      {"wrist radial deviation", kTreeRightWrist, kTreeLeftWrist, -kZ, kAway, {20, 20, 20, 20, 20}},
      {"wrist ulnar deviation", kTreeRightWrist, kTreeLeftWrist, kZ, kInwards, {30, 35, 30, 30, 30}},
      {"hip flexion", kTreeRightHip, kTreeLeftHip, -kX, kForward, {120, 125, 135, 100, 120}},
      {"hip extension", kTreeRightHip, kTreeLeftHip, kX, kBackward, {30, 10, 30, 30, 30}},
      {"hip abduction", kTreeRightHip, kTreeLeftHip, -kZ, kAway, {45, 45, 50, 40, 45}},
      {"hip adduction", kTreeRightHip, kTreeLeftHip, kZ, kInwards, {30, 10, 30, 20, 30}},
      {"hip outer rotation", kTreeRightHip, kTreeLeftHip, -kY, kFrontAway, {45, 45, 45, 40, 45}},
      {"hip inner rotation", kTreeRightHip, kTreeLeftHip, kY, kFrontInwards, {45, 45, 35, 50, 45}},
      {"knee flexion", kTreeRightKnee, kTreeLeftKnee, kX, kBackward, {135, 140, 135, 150, 135}},
      {"knee extension", kTreeRightKnee, kTreeLeftKnee, -kX, kForward, {0, 0, 0, 0, 0}},
      {"dorsiflexion", kTreeRightAnkle, kTreeLeftAnkle, -kX, kUp, {20, 20, 20, 20, 20}},
      {"plantarflexion", kTreeRightAnkle, kTreeLeftAnkle, kX, kDown, {50, 45, 50, 40, 50}},
  };
  return rows;
}

// Movements of a single joint; the trunk's upper part counts as the outer one.
const std::vector<TableRow>& SingleRows() {
  static const std::vector<TableRow> rows = {
      {"inversion", kTreeRightAnkle, kTreeRightAnkle, kY, kInwards, {35, 35, 35, 30, 20}},
      {"eversion", kTreeRightAnkle, kTreeRightAnkle, -kY, kAway, {15, 20, 15, 20, 20}},
      {"neck flexion", kTreeNeck, kTreeNeck, kX, kForward, {45, 45, 45, 60, 45}},
      {"neck extension", kTreeNeck, kTreeNeck, -kX, kBackward, {45, 45, 45, 75, 45}},
      {"neck to the right", kTreeNeck, kTreeNeck, kZ, kInwards, {45, 45, 45, 45, 45}},
      {"neck to the left", kTreeNeck, kTreeNeck, -kZ, kAway, {45, 45, 45, 45, 45}},
      {"neck turns right", kTreeNeck, kTreeNeck, -kY, kFrontInwards, {60, 60, 60, 80, 60}},
      {"neck turns left", kTreeNeck, kTreeNeck, kY, kFrontAway, {60, 60, 60, 80, 60}},
      {"trunk flexion", kTreeNavel, kTreeNavel, kX, kForward, {80, 80, 80, 50, 70}},
      {"trunk extension", kTreeNavel, kTreeNavel, -kX, kBackward, {25, 25, 25, 25, 25}},
      {"trunk to the right", kTreeNavel, kTreeNavel, kZ, kInwards, {35, 35, 35, 25, 35}},
      {"trunk to the left", kTreeNavel, kTreeNavel, -kZ, kAway, {35, 35, 35, 25, 35}},
      {"trunk turns right", kTreeNavel, kTreeNavel, -kY, kFrontInwards, {45, 45, 45, 30, 45}},
      {"trunk turns left", kTreeNavel, kTreeNavel, kY, kFrontAway, {45, 45, 45, 30, 45}},
  };
  return rows;
}

bool IsClimbed(int joint) { return joint == kTreeLeftAnkle || joint == kTreeLeftKnee || joint == kTreeLeftHip; }

// Returns the rotation of a limb's outer part since rest, relative to the inner part.
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

// Returns how far `limits` let an angle of `joint` turn about `axis`, degrees; nothing if no angle does.
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

glm::dvec3 Mirrored(const glm::dvec3& axis) { return {axis.x, -axis.y, -axis.z}; }

TEST(JointLimits, PosedBodiesMoveAsFarAsTheTableSaysOnBothSides) {
  int checked = 0;
  for (std::size_t column = 0; column < kSets.size(); ++column) {
    const std::vector<AngleRange> limits = JointLimits(kSets[column]);
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
  // Both ends of 29 angles in five sets: every limit was checked.
  EXPECT_EQ(checked, 2 * 29 * 5);
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

// Returns the direction in which the outer part of a limb moves if the angle `dof` is `radians` and all others are 0.
Way WayOf(const KinematicTree& body, int joint, int dof, double radians) {
  std::vector<double> angles(body.limits.size(), 0.0);
  angles[dof] = radians;
  const glm::dmat3 turned = TurnedBy(body, joint, angles);
  const TreeFrames rest = ComputeFrames(body, StandingState(body));
  // A climbed limb points towards the trunk.
  const glm::dvec3 limb =
      IsClimbed(joint) ? -rest.joints[body.joints[joint].parent].axes[2] : rest.joints[joint].axes[2];
  const bool is_right = joint == kTreeRightShoulder || joint == kTreeRightElbow || joint == kTreeRightWrist ||
                        joint == kTreeRightHip || joint == kTreeRightKnee || joint == kTreeRightAnkle;
  const double away = is_right ? -1 : 1;  // the body's left is +X
  constexpr double kFar = 0.01;
  const glm::dvec3 end_goes = turned * limb - limb;
  if (std::abs(end_goes.x) > kFar) return end_goes.x * away > 0 ? kAway : kInwards;
  if (std::abs(limb.z) < kFar && std::abs(end_goes.z) > kFar) return end_goes.z > 0 ? kForward : kBackward;
  if (std::abs(end_goes.y) > kFar) return end_goes.y > 0 ? kUp : kDown;
  const glm::dvec3 front_goes = turned * kZ - kZ;
  if (std::abs(front_goes.x) > kFar) return front_goes.x * away > 0 ? kFrontAway : kFrontInwards;
  return kNowhere;
}

// Returns the movements whose range in `limits` differs from column `column`, by name; "?" for one that the table
// lacks. Each angle is moved half-way to each limit, where a raised arm still points to its side; a limit of zero is
// tried at 0.1.
std::vector<std::string> Disagreements(const std::vector<AngleRange>& limits, std::size_t column, int& looked_at) {
  const KinematicTree body = MakeBodyTree({});
  std::vector<std::string> wrong;
  for (int joint = 0; joint < static_cast<int>(body.joints.size()); ++joint) {
    for (int k = 0; k < body.joints[joint].dof_count; ++k) {
      const int dof = body.joints[joint].first_dof + k;
      for (const bool rises : {false, true}) {
        const double end = rises ? limits[dof].upper : limits[dof].lower;
        const Way goes = WayOf(body, joint, dof, end != 0 ? end / 2 : rises ? 0.1 : -0.1);
        const auto is_it = [&](const TableRow& row) {
          return (row.right == joint || row.left == joint) && row.goes == goes;
        };
        const TableRow* found = nullptr;
        for (const auto* rows : {&PairedRows(), &SingleRows()}) {
          if (const auto row = std::ranges::find_if(*rows, is_it); row != rows->end()) found = &*row;
        }
        if (found == nullptr || std::abs(Degrees(std::abs(end)) - found->degrees[column]) > 1e-9) {
          wrong.push_back(std::string(body.joints[joint].name) + ": " +
                          std::string(found == nullptr ? "?" : found->movement));
        }
        ++looked_at;
      }
    }
  }
  return wrong;
}

TEST(JointLimits, LeadEveryLimbAsFarAsTheMovementThatItMakes) {
  for (std::size_t column = 0; column < kSets.size(); ++column) {
    int looked_at = 0;
    EXPECT_THAT(Disagreements(JointLimits(kSets[column]), column, looked_at), ::testing::IsEmpty()) << column;
    EXPECT_EQ(looked_at, 2 * 29);
  }
}

// The control: if one angle's asymmetric range is mirrored, exactly the two movements of this angle are reported.
TEST(JointLimits, ThatAreExchangedAreFlagged) {
  int exchanged = 0;
  for (std::size_t column = 0; column < kSets.size(); ++column) {
    const std::vector<AngleRange> limits = JointLimits(kSets[column]);
    for (std::size_t dof = 0; dof < limits.size(); ++dof) {
      if (std::abs(limits[dof].upper + limits[dof].lower) < 1e-9) continue;
      std::vector<AngleRange> wrong = limits;
      wrong[dof] = {-limits[dof].upper, -limits[dof].lower};
      int looked_at = 0;
      EXPECT_EQ(Disagreements(wrong, column, looked_at).size(), 2u) << "column " << column << ", angle " << dof;
      ++exchanged;
    }
  }
  EXPECT_GT(exchanged, 5 * 15);
}

// The errors of an earlier `adult`: the left hip's ab- and adduction, and the wrists' radial and ulnar deviation.
TEST(JointLimits, OfAnEarlierAdultAreFlagged) {
  std::vector<AngleRange> earlier = JointLimits(LimitSet::kAdult);
  const KinematicTree body = MakeBodyTree({});
  for (const int dof : {body.joints[kTreeLeftHip].first_dof, body.joints[kTreeLeftWrist].first_dof + 1,
                        body.joints[kTreeRightWrist].first_dof + 1}) {
    earlier[dof] = {-earlier[dof].upper, -earlier[dof].lower};
  }
  int looked_at = 0;
  EXPECT_THAT(Disagreements(earlier, 4, looked_at),
              ::testing::ElementsAre("left_hip: hip abduction", "left_hip: hip adduction",
                                     "left_wrist: wrist radial deviation", "left_wrist: wrist ulnar deviation",
                                     "right_wrist: wrist ulnar deviation", "right_wrist: wrist radial deviation"));
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
