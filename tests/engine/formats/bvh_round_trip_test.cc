#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "engine/base/angles.h"
#include "engine/formats/bvh.h"
#include "tests/support/person.h"
#include "tests/support/random_clip.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::RandomClip;
using testing::Resting;
using testing::WorstDistance;

// The largest errors of a position and of a rotation whose three numbers are rounded to six decimals.
const double kPrintedLength = 0.5e-6 * std::sqrt(3.0) * (1 + 1e-6);
const double kPrintedTurn = Radians(3 * 0.5e-6) * (1 + 1e-6);

Clip Again(const Clip& clip) {
  const auto read = ReadBvh(WriteBvh(clip), "again.bvh");
  EXPECT_TRUE(read) << ToString(read.error());
  return read ? *read : Clip{};
}

double TurnBetween(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat turn = glm::conjugate(a) * b;
  return 2 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
}

/// Returns a joint's rest position after writing and reading: the origin for the root; for a joint that leaves its rest
/// translation, the first frame's.
glm::dvec3 RestInBvh(const Clip& clip, std::size_t joint) {
  const glm::dvec3 rest = clip.skeleton.joints[joint].rest.translation;
  if (clip.skeleton.joints[joint].parent < 0) return glm::dvec3(0);
  const auto leaves = [&](const LocalPose& pose) { return glm::distance(pose[joint].translation, rest) > 1e-6; };
  return std::ranges::any_of(clip.frames, leaves) ? clip.frames.front()[joint].translation : rest;
}

/// Checks that joints of the same name differ by no more than six decimals.
void ExpectTheSameToThePrintedPrecision(const Clip& clip, const Clip& again) {
  ASSERT_EQ(again.skeleton.joints.size(), clip.skeleton.joints.size());
  ASSERT_EQ(again.frames.size(), clip.frames.size());
  EXPECT_NEAR(again.rate_hz, clip.rate_hz, 1e-6);
  double worst_shift = 0, worst_turn = 0;
  for (std::size_t i = 0; i < clip.skeleton.joints.size(); ++i) {
    const Joint& joint = clip.skeleton.joints[i];
    const int twin = again.skeleton.Find(joint.name);
    ASSERT_GE(twin, 0) << joint.name;
    EXPECT_LT(glm::distance(again.skeleton.joints[twin].rest.translation, RestInBvh(clip, i)), kPrintedLength);
    for (std::size_t f = 0; f < clip.frames.size(); ++f) {
      const LocalTransform &a = clip.frames[f][i], &b = again.frames[f][twin];
      worst_shift = std::max(worst_shift, glm::distance(a.translation, b.translation));
      worst_turn = std::max(worst_turn, TurnBetween(a.rotation, b.rotation));
    }
  }
  EXPECT_LT(worst_shift, kPrintedLength);
  EXPECT_LT(worst_turn, kPrintedTurn);
}

TEST(BvhRoundTrip, KeepsRandomClipsToThePrintedPrecision) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Clip clip = RandomClip(seed, {.moving_offsets = seed % 2 == 1});
    ExpectTheSameToThePrintedPrecision(clip, Again(clip));
  }
}

TEST(BvhRoundTrip, KeepsEveryRealClipToThePrintedPrecision) {
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/usr/share/assimp/models/BVH")) {
    if (entry.path().extension() != ".bvh") continue;
    SCOPED_TRACE(entry.path());
    std::ifstream in(entry.path(), std::ios::binary);
    ASSERT_OK(clip, ReadBvh(std::string(std::istreambuf_iterator<char>(in), {}), "real.bvh"));
    const Clip again = Again(*clip);
    ExpectTheSameToThePrintedPrecision(*clip, again);
    EXPECT_TRUE(WriteBvh(again) == WriteBvh(*clip)) << "written again, the text is another";
    ++read;
  }
  EXPECT_GE(read, 3) << "not installed: package assimp-testmodels";
}

TEST(BvhRoundTrip, KeepsJointsOfAnySceneWhereTheyAreAndWhatRestsWithoutMoving) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Clip clip = RandomClip(seed, {.roots = 1 + static_cast<int>(seed % 3),
                                        .rest_rotations = true,
                                        .moving_offsets = seed % 2 == 1,
                                        .scales = seed % 4 >= 2});
    const Clip again = Again(clip);
    // Bound: a chain of ten joints of length 2 (4 if scaled), each turned by the rounding of six decimals.
    EXPECT_LT(WorstDistance(clip, again), 1e-5);
    const bool rests_as_before = seed % 2 == 0 && seed % 4 < 2 && seed % 3 == 0;
    Clip rooted = clip;
    rooted.skeleton.joints.front().rest.translation = glm::dvec3(0);
    if (rests_as_before) {
      EXPECT_LT(WorstDistance(Resting(rooted), Resting(again)), 1e-5);
    }
    for (const Joint& joint : again.skeleton.joints) EXPECT_EQ(joint.rest.rotation, glm::dquat(1, 0, 0, 0));
  }
}

TEST(BvhRoundTrip, WritesPositionsOnlyWhereTheyShow) {
  Clip clip = RandomClip(3);
  clip.frames[1][4].translation.x += 1e-9;  // the rounding of single-precision files
  const std::string text = WriteBvh(clip);
  EXPECT_EQ(text.find("CHANNELS 6"), text.rfind("CHANNELS 6"));
  clip.frames[1][4].translation.x += 2e-6;
  EXPECT_NE(WriteBvh(clip).find("CHANNELS 6"), WriteBvh(clip).rfind("CHANNELS 6"));
}

TEST(BvhRoundTrip, MakesJointsOfEndSitesThatMoveOrHaveChildren) {
  Clip clip = testing::AtRest(testing::PersonSkeleton(), 2);
  testing::At(clip, 1, "Head_End").translation.y += 3;
  clip.skeleton.joints.push_back({.name = "Ring", .parent = clip.skeleton.Find("LeftHand_End"), .rest = {}});
  for (LocalPose& pose : clip.frames) pose.push_back({});
  const Clip again = Again(clip);
  EXPECT_LT(WorstDistance(clip, again), 1e-6);
  EXPECT_FALSE(again.skeleton.joints[again.skeleton.Find("Head_End")].is_end_site);
  EXPECT_FALSE(again.skeleton.joints[again.skeleton.Find("LeftHand_End")].is_end_site);
  EXPECT_TRUE(again.skeleton.joints[again.skeleton.Find("RightHand_End")].is_end_site);
}

TEST(BvhRoundTrip, KeepsNamesThatALineCanHold) {
  constexpr std::pair<const char*, const char*> kNames[] = {
      {"Bip01 L Thigh", "Bip01 L Thigh"},
      {"mixamorig:LeftArm", "mixamorig:LeftArm"},
      {"a\nb\rc\td", "a_b_c_d"},
      {"Arm {left}", "Arm _left_"},
      {"  Arm ", "Arm"},
      {"", "unnamed"},
      {"Ärmel", "Ärmel"},
  };
  for (const auto& [name, expected] : kNames) {
    Clip clip = RandomClip(5);
    clip.skeleton.joints[4].name = name;
    EXPECT_GE(Again(clip).skeleton.Find(expected), 0) << name;
  }
}

TEST(BvhRoundTrip, TellsJointsOfOneNameApart) {
  Clip clip = RandomClip(7);
  for (Joint& joint : clip.skeleton.joints) joint.name = "bone";
  clip.skeleton.joints[0].name = "bone#2";
  const Clip again = Again(clip);
  std::set<std::string> names;
  for (const Joint& joint : again.skeleton.joints) names.insert(joint.name);
  EXPECT_EQ(names.size(), clip.skeleton.joints.size());
  for (const char* name : {"bone", "bone#2", "bone#3", "bone#10"}) EXPECT_TRUE(names.contains(name)) << name;
  // The text itself has unique names, for other programs.
  const std::string text = WriteBvh(clip);
  EXPECT_EQ(text.find("JOINT bone\n"), text.rfind("JOINT bone\n"));
}

TEST(BvhRoundTrip, WritesNamesWithoutTheBlanksAroundThem) {
  Clip clip = RandomClip(6);
  clip.skeleton.joints[0].name = "  two words   ";
  EXPECT_NE(WriteBvh(clip).find("ROOT two words\n"), std::string::npos);
  clip.skeleton.joints[0].name = "   ";
  EXPECT_NE(WriteBvh(clip).find("ROOT unnamed\n"), std::string::npos);
}

TEST(BvhRoundTrip, PrintsNumbersAsTheyAreRoundedToSixDecimals) {
  Clip clip = RandomClip(6);
  clip.frames = {RestPose(clip.skeleton)};
  constexpr std::pair<double, const char*> kNumbers[] = {
      {0, "0.000000"},           {-0.0, "0.000000"},         {-0.4e-6, "0.000000"},
      {0.6e-6, "0.000001"},      {-0.6e-6, "-0.000001"},     {0.0625, "0.062500"},
      {-1.9999996, "-2.000000"}, {-12.000034, "-12.000034"}, {999999.999999, "999999.999999"},
      {1e9, "1000000000.000000"}};
  for (const auto& [number, printed] : kNumbers) {
    clip.frames[0][0].translation = {number, 7, number};
    const std::string text = WriteBvh(clip);
    const std::string frame = text.substr(text.find('\n', text.find("Frame Time")) + 1);
    EXPECT_TRUE(frame.starts_with(fmt::format("{0} 7.000000 {0} ", printed))) << number << " in " << frame;
  }
}

}  // namespace
}  // namespace etude
