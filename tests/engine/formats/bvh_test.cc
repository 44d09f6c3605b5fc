#include "engine/formats/bvh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/angles.h"
#include "tests/engine/formats/small_bvh.h"
#include "tests/support/person.h"
#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using testing::kSmallBvh;
using testing::Replaced;

std::vector<GlobalTransform> Globals(const Clip& clip, std::size_t frame) {
  std::vector<GlobalTransform> globals;
  ComputeGlobals(clip.skeleton, clip.frames[frame], globals);
  return globals;
}

void ExpectBvhNear(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance = 1e-12) {
  EXPECT_LT(glm::distance(actual, expected), tolerance)
      << "(" << actual.x << ", " << actual.y << ", " << actual.z << ")";
}

/// Rotation by the textbook's matrix, a second implementation for quaternions.
glm::dmat3 AxisMatrix(char axis, double degrees) {
  const double c = std::cos(Radians(degrees)), s = std::sin(Radians(degrees));
  switch (axis) {
    case 'X':
      return glm::transpose(glm::dmat3(1, 0, 0, 0, c, -s, 0, s, c));
    case 'Y':
      return glm::transpose(glm::dmat3(c, 0, s, 0, 1, 0, -s, 0, c));
    default:
      return glm::transpose(glm::dmat3(c, -s, 0, s, c, 0, 0, 0, 1));
  }
}

TEST(Bvh, ReadsTheTreeOfJointsAndEndSites) {
  ASSERT_OK(clip, ReadBvh(kSmallBvh, "some/folder/wave.v2.bvh"));
  EXPECT_EQ(clip->name, "wave.v2");
  ASSERT_EQ(clip->skeleton.joints.size(), 3u);
  EXPECT_EQ(clip->skeleton.joints[0].name, "Hips");
  EXPECT_EQ(clip->skeleton.joints[0].parent, -1);
  EXPECT_EQ(clip->skeleton.joints[1].name, "Arm");
  EXPECT_EQ(clip->skeleton.joints[1].parent, 0);
  EXPECT_EQ(clip->skeleton.joints[2].name, "Arm_End");
  EXPECT_EQ(clip->skeleton.joints[2].parent, 1);
  EXPECT_TRUE(clip->skeleton.joints[2].is_end_site);
  EXPECT_EQ(clip->frames.size(), 2u);
}

TEST(Bvh, PlacesJointsWhereForwardKinematicsByHandDoes) {
  ASSERT_OK(clip, ReadBvh(kSmallBvh, "small.bvh"));
  // The root is turned by 90° about Z: up becomes −X, and the arm's +X becomes up.
  const auto turned_root = Globals(*clip, 0);
  ExpectBvhNear(turned_root[0].position, {1, 2, 3});
  ExpectBvhNear(turned_root[1].position, {-9, 2, 3});
  ExpectBvhNear(turned_root[2].position, {-9, 7, 3});
  // Only the arm is turned.
  const auto turned_arm = Globals(*clip, 1);
  ExpectBvhNear(turned_arm[1].position, {1, 12, 3});
  ExpectBvhNear(turned_arm[2].position, {1, 17, 3});
}

TEST(Bvh, MultipliesRotationsInTheOrderOfTheChannels) {
  std::string order = "XYZ";
  int checked = 0;
  do {
    const std::string channels =
        fmt::format("CHANNELS 3 {}rotation {}rotation {}rotation", order[0], order[1], order[2]);
    std::string text = Replaced(kSmallBvh, "CHANNELS 3 Zrotation Yrotation Xrotation", channels);
    text = Replaced(text, "1 2 3 90 0 0 0 0 0", "0 0 0 0 0 0 20 -35 70");
    ASSERT_OK(clip, ReadBvh(text, "order.bvh"));
    const glm::dmat3 expected = AxisMatrix(order[0], 20) * AxisMatrix(order[1], -35) * AxisMatrix(order[2], 70);
    ExpectBvhNear(Globals(*clip, 0)[2].position, glm::dvec3(0, 10, 0) + expected * glm::dvec3(5, 0, 0));
    ++checked;
  } while (std::ranges::next_permutation(order).found);
  EXPECT_EQ(checked, 6);
}

TEST(Bvh, KeepsTheChannelOrderOfEveryJoint) {
  // Rotations come before positions at the root; the arm has a single rotation.
  std::string text = Replaced(kSmallBvh, "Xposition Yposition Zposition Zrotation Xrotation Yrotation",
                              "Yrotation Zposition Xposition Xrotation Yposition Zrotation");
  text = Replaced(text, "CHANNELS 3 Zrotation Yrotation Xrotation", "CHANNELS 1 Zrotation");
  text = Replaced(text, "1 2 3 90 0 0 0 0 0", "90 3 1 0 2 0 90");
  text = Replaced(text, "1 2 3 0 0 0 90 0 0", "0 3 1 0 2 0 0");
  ASSERT_OK(clip, ReadBvh(text, "mixed.bvh"));
  const auto globals = Globals(*clip, 0);
  ExpectBvhNear(globals[0].position, {1, 2, 3});
  ExpectBvhNear(globals[1].position, {1, 12, 3});  // about Y: up stays up
  ExpectBvhNear(globals[2].position, {1, 17, 3});  // the arm's own turn about Z raises its tip
}

TEST(Bvh, PositionChannelsReplaceTheOffsetOfAnyJoint) {
  std::string text = Replaced(kSmallBvh, "OFFSET 0 0 0", "OFFSET 7 8 9");
  text = Replaced(text, "CHANNELS 3 Zrotation Yrotation Xrotation", "CHANNELS 2 Zposition Xposition");
  text = Replaced(text, "1 2 3 90 0 0 0 0 0", "1 2 3 0 0 0 6 4");
  text = Replaced(text, "1 2 3 0 0 0 90 0 0", "1 2 3 0 0 0 0 0");
  ASSERT_OK(clip, ReadBvh(text, "positions.bvh"));
  ExpectBvhNear(clip->frames[0][0].translation, {1, 2, 3});
  ExpectBvhNear(clip->frames[0][1].translation, {4, 10, 6});  // Y has no channel, so it keeps its offset
  ExpectBvhNear(clip->skeleton.joints[0].rest.translation, {7, 8, 9});
}

TEST(Bvh, TakesAPrintedFrameTimeForTheWholeRateItMeans) {
  const auto rate = [](std::string_view time) {
    const auto clip = ReadBvh(Replaced(kSmallBvh, ".0083333", time), "rate.bvh");
    return clip ? clip->rate_hz : -1;
  };
  EXPECT_EQ(rate(".0083333"), 120);
  EXPECT_EQ(rate("0.008333"), 120);
  EXPECT_EQ(rate("0.033333"), 30);
  EXPECT_EQ(rate("+1e-2"), 100);
  EXPECT_NEAR(rate("0.0333667"), 29.97, 1e-4);  // 29.97 Hz, not a rounded 30
}

TEST(Bvh, ReadsWindowsLineEndsTabsOddCaseAndAMissingLastNewline) {
  std::string text;
  for (char c : Replaced(kSmallBvh, "End Site", "END\tsite"))
    text += c == '\n' ? std::string("\t\r\n") : std::string(1, c);
  text = Replaced(Replaced(text, "ROOT Hips", "\n\nroot My Hips"), "Frames: 2", "FRAMES :2");
  text = "\xEF\xBB\xBF" + Replaced(text, "Xposition Y", "XPosition\r\n\tY");
  while (text.back() != '0') text.pop_back();
  ASSERT_OK(clip, ReadBvh(text, "windows.bvh"));
  EXPECT_EQ(clip->skeleton.joints[0].name, "My Hips");
  ExpectBvhNear(Globals(*clip, 0)[2].position, {-9, 7, 3});
}

TEST(Bvh, DropsTheOneFrameThatSomeExportersWriteBeyondTheirCount) {
  ASSERT_OK(clip, ReadBvh(Replaced(kSmallBvh, "Frames: 2", "Frames: 1"), "boxing.bvh"));
  EXPECT_EQ(clip->frames.size(), 1u);
  ExpectBvhNear(Globals(*clip, 0)[2].position, {-9, 7, 3});
}

TEST(Bvh, WritesAFileThatCanBeReadByEye) {
  ASSERT_OK(clip, ReadBvh(kSmallBvh, "small.bvh"));
  EXPECT_EQ(WriteBvh(*clip),
            "HIERARCHY\n"
            "ROOT Hips\n"
            "{\n"
            "\tOFFSET 0.000000 0.000000 0.000000\n"
            "\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
            "\tJOINT Arm\n"
            "\t{\n"
            "\t\tOFFSET 0.000000 10.000000 0.000000\n"
            "\t\tCHANNELS 3 Zrotation Xrotation Yrotation\n"
            "\t\tEnd Site\n"
            "\t\t{\n"
            "\t\t\tOFFSET 5.000000 0.000000 0.000000\n"
            "\t\t}\n"
            "\t}\n"
            "}\n"
            "MOTION\n"
            "Frames: 2\n"
            "Frame Time: 0.0083333333\n"
            "1.000000 2.000000 3.000000 90.000000 0.000000 0.000000 0.000000 0.000000 0.000000\n"
            "1.000000 2.000000 3.000000 0.000000 0.000000 0.000000 90.000000 0.000000 0.000000\n");
}

TEST(Bvh, WritesJointsDepthFirstWhateverTheirOrder) {
  // Joints breadth first, so that the legs alternate.
  Skeleton skeleton;
  skeleton.joints = {{"root", -1, {}},
                     {"left", 0, {{1, 0, 0}}},
                     {"right", 0, {{-1, 0, 0}}},
                     {"left_tip", 1, {{0, -1, 0}}},
                     {"right_tip", 2, {{0, -1, 0}}}};
  Clip clip = testing::AtRest(skeleton, 1);
  clip.frames[0][1].rotation = testing::Turn(0.5, {0, 0, 1});
  clip.frames[0][2].rotation = testing::Turn(0.7, {1, 0, 0});
  ASSERT_OK(read, ReadBvh(WriteBvh(clip), "code.bvh"));
  std::vector<std::string> names;
  for (const Joint& joint : read->skeleton.joints) names.push_back(joint.name);
  EXPECT_THAT(names, ElementsAre("root", "left", "left_tip", "right", "right_tip"));
  const auto before = Globals(clip, 0);
  const auto after = Globals(*read, 0);
  for (const char* name : {"left_tip", "right_tip"}) {
    ExpectBvhNear(after[read->skeleton.Find(name)].position, before[skeleton.Find(name)].position, 1e-7);
  }
}

TEST(Bvh, WritesPositionsOfAJointThatLeavesItsOffset) {
  auto clip = ReadBvh(kSmallBvh, "small.bvh");
  ASSERT_TRUE(clip);
  clip->frames[1][1].translation = {0, 12.5, 0};
  ASSERT_OK(read, ReadBvh(WriteBvh(*clip), "stretched.bvh"));
  ExpectBvhNear(read->frames[0][1].translation, {0, 10, 0});
  ExpectBvhNear(read->frames[1][1].translation, {0, 12.5, 0});
}

TEST(Bvh, WritesRotationsAtTheEulerAnglesOwnPole) {
  for (const double x : {90.0, -90.0, 89.9999999, 90.0000001}) {
    auto clip = ReadBvh(kSmallBvh, "small.bvh");
    ASSERT_TRUE(clip);
    const glm::dquat wanted =
        testing::Turn(0.4, {0, 0, 1}) * testing::Turn(Radians(x), {1, 0, 0}) * testing::Turn(-1, {0, 1, 0});
    clip->frames[0][1].rotation = wanted;
    ASSERT_OK(read, ReadBvh(WriteBvh(*clip), "pole.bvh"));
    EXPECT_NEAR(std::abs(glm::dot(read->frames[0][1].rotation, wanted)), 1, 1e-14) << x;
  }
}

}  // namespace
}  // namespace etude
