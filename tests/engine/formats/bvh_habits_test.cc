// Deviations from the format that exporters write; none may change the motion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "engine/formats/bvh.h"
#include "tests/engine/formats/small_bvh.h"
#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::kSmallBvh;
using testing::Replaced;

std::string ReplacedEverywhere(std::string_view text, std::string_view from, std::string_view to) {
  std::string out(text);
  for (std::size_t at = 0; (at = out.find(from, at)) != std::string::npos; at += to.size()) {
    out.replace(at, from.size(), to);
  }
  return out;
}

void ExpectTheSmallMotion(const std::string& text) {
  const auto expected = ReadBvh(kSmallBvh, "small.bvh");
  ASSERT_OK(clip, ReadBvh(text, "habit.bvh"));
  EXPECT_EQ(clip->rate_hz, expected->rate_hz);
  EXPECT_EQ(clip->frames, expected->frames);
  EXPECT_EQ(RestPose(clip->skeleton), RestPose(expected->skeleton));
}

struct Habit {
  const char* what;
  const char* from;
  const char* to;
};

constexpr Habit kHabits[] = {
    {"nothing changed: the control", "HIERARCHY", "HIERARCHY"},
    {"blank lines before everything", "HIERARCHY", "\n \t\n\nHIERARCHY"},
    {"blank lines before the frames", ".0083333\n", ".0083333\n\n  \n"},
    {"blank lines between the frames", "1 2 3 90 0 0 0 0 0\n", "1 2 3 90 0 0 0 0 0\n\n\n"},
    {"blank lines after the frames", "1 2 3 0 0 0 90 0 0", "1 2 3 0 0 0 90 0 0\n\n\t\n"},
    {"no blank line's end at the end", "0 90 0 0\n", "0 90 0 0"},
    {"blanks around a frame", "1 2 3 90 0 0 0 0 0", "  1\t2  3 90 0 0 0 0 0 \t "},
    {"Maya's End site", "End Site", "End site"},
    {"a name behind End Site", "End Site", "End Site Arm Tip"},
    {"the bracket on the joint's line", "JOINT Arm\n  {", "JOINT Arm {"},
    {"the bracket glued to the name", "JOINT Arm\n  {", "JOINT Arm{"},
    {"channels before the offset", "OFFSET 0 10 0\n    CHANNELS 3 Zrotation Yrotation Xrotation",
     "CHANNELS 3 Zrotation Yrotation Xrotation\n    OFFSET 0 10 0"},
    {"no blank behind a colon", "Frames: 2\nFrame Time: ", "Frames:2\nFrame Time:"},
    {"a tab behind a colon", "Frames: 2\nFrame Time: ", "Frames:\t2\nFrame Time:\t"},
    {"a frame time with an exponent", ".0083333", "8.3333333e-03"},
    {"numbers with exponents and signs", "1 2 3 90 0 0", "+1 2.0e0 .3E+1 9e1 -0 0.000"},
};

TEST(BvhHabits, AreReadLikeTheLetterOfTheFormat) {
  for (const Habit& habit : kHabits) {
    SCOPED_TRACE(habit.what);
    ExpectTheSmallMotion(Replaced(kSmallBvh, habit.from, habit.to));
  }
}

TEST(BvhHabits, IncludeTheLineEndsOfEverySystem) {
  for (const char* line_end : {"\n", "\r\n", "\r", "\r\r\n", " \r\n", "\t\r"}) {
    ExpectTheSmallMotion(ReplacedEverywhere(kSmallBvh, "\n", line_end));
    ExpectTheSmallMotion("\xEF\xBB\xBF" + ReplacedEverywhere(kSmallBvh, "\n", line_end));
  }
}

TEST(BvhHabits, LeaveLinesCountedOnceUnderEverySystemsLineEnds) {
  for (const char* line_end : {"\n", "\r\n", "\r"}) {
    const std::string broken = Replaced(kSmallBvh, "1 2 3 0", "1 2 x 0");
    const auto clip = ReadBvh(ReplacedEverywhere(broken, "\n", line_end), "broken.bvh");
    ASSERT_FALSE(clip);
    EXPECT_EQ(ToString(clip.error().place), "broken.bvh:20:5");
  }
}

std::vector<std::string> NamesOf(const std::string& text) {
  const auto clip = ReadBvh(text, "names.bvh");
  std::vector<std::string> names;
  if (!clip) return {ToString(clip.error())};
  for (const Joint& joint : clip->skeleton.joints) names.push_back(joint.name);
  return names;
}

TEST(BvhHabits, IncludeNamesWithBlanksColonsAndSigns) {
  for (const std::string name :
       {"Bip01 L Thigh", "mixamorig:LeftArm", "upperarm.l", "JOINT", "Hüfte", "a|b\\c", "\"quoted\""}) {
    const std::string text = Replaced(kSmallBvh, "JOINT Arm", "JOINT " + name);
    EXPECT_EQ(NamesOf(text), (std::vector<std::string>{"Hips", name, name + "_End"}));
  }
}

TEST(BvhHabits, IncludeOneNameForSeveralJointsWhichCanStillBeTold) {
  const std::string twins = Replaced(kSmallBvh, "    End Site\n",
                                     "    JOINT Hips\n    { OFFSET 0 0 0 CHANNELS 0\n End Site\n { OFFSET 1 0 0 } }\n"
                                     "    End Site\n    { OFFSET 2 0 0 }\n    End Site\n");
  EXPECT_EQ(NamesOf(twins), (std::vector<std::string>{"Hips", "Arm", "Hips#2", "Hips#2_End", "Arm_End", "Arm_End#2"}));
}

TEST(BvhHabits, IncludeJointsWithoutOrWithFewChannels) {
  // An arm without the line CHANNELS stays at rest.
  std::string text = Replaced(kSmallBvh, "    CHANNELS 3 Zrotation Yrotation Xrotation\n", "");
  text = ReplacedEverywhere(text, "1 2 3 0 0 0 90 0 0", "1 2 3 0 0 0");
  text = ReplacedEverywhere(text, "1 2 3 90 0 0 0 0 0", "1 2 3 90 0 0");
  ASSERT_OK(none, ReadBvh(text, "none.bvh"));
  EXPECT_EQ(none->frames[1][1], none->skeleton.joints[1].rest);
  // Two rotations about the same frame's axes, in the order written.
  text = Replaced(kSmallBvh, "CHANNELS 3 Zrotation Yrotation Xrotation", "CHANNELS 2 Xrotation Zrotation");
  text = Replaced(Replaced(text, "90 0 0 0 0 0", "90 0 0 30 40"), "0 0 0 90 0 0", "0 0 0 0 90");
  ASSERT_OK(two, ReadBvh(text, "two.bvh"));
  const glm::dquat expected =
      glm::angleAxis(glm::radians(30.0), glm::dvec3(1, 0, 0)) * glm::angleAxis(glm::radians(40.0), glm::dvec3(0, 0, 1));
  EXPECT_NEAR(std::abs(glm::dot(two->frames[0][1].rotation, expected)), 1, 1e-15);
}

TEST(BvhHabits, OfARowTooManyAreTold) {
  std::vector<std::string> remarks;
  ASSERT_TRUE(ReadBvh(kSmallBvh, "small.bvh", &remarks));
  EXPECT_TRUE(remarks.empty()) << "the control";
  ASSERT_OK(clip, ReadBvh(Replaced(kSmallBvh, "Frames: 2", "Frames: 1"), "small.bvh", &remarks));
  EXPECT_EQ(clip->frames.size(), 1u);
  EXPECT_EQ(remarks, (std::vector<std::string>{"found 2 rows, but the file states 1 frames, so the last row is left "
                                               "out"}));
}

TEST(BvhHabits, OfAnglesInRadiansAreTold) {
  std::vector<std::string> remarks;
  const std::string radians = Replaced(Replaced(kSmallBvh, "1 2 3 90 0", "1 2 3 1.571 0"), "0 0 0 90 0 0", "0 0 0 1.571 0 0");
  ASSERT_TRUE(ReadBvh(radians, "small.bvh", &remarks));
  EXPECT_EQ(remarks, (std::vector<std::string>{"no joint rotates by more than 1.6 degrees; if the file's angles are "
                                               "radians, convert them to degrees, as BVH requires"}));
}

TEST(BvhHabits, IncludePlacesInTheChannelsAlone) {
  std::string text = Replaced(kSmallBvh, "OFFSET 0 10 0\n    CHANNELS 3",
                              "OFFSET 0 0 0\n    CHANNELS 6 Xposition Yposition Zposition");
  text = Replaced(Replaced(text, "OFFSET 5 0 0", "OFFSET 0 0 0"), "90 0 0 0 0 0", "90 0 0 0 10 1 0 0 0");
  text = Replaced(text, "0 0 0 90 0 0", "0 0 0 0 11 1 90 0 0");
  std::vector<std::string> remarks;
  ASSERT_OK(clip, ReadBvh(text, "places.bvh", &remarks));
  EXPECT_EQ(clip->skeleton.joints[1].rest.translation, glm::dvec3(0, 10, 1));
  EXPECT_EQ(clip->frames[1][1].translation, glm::dvec3(0, 11, 1));
  EXPECT_EQ(remarks, (std::vector<std::string>{
                         "joints with position channels and an OFFSET of 0 get their rest positions from the first "
                         "frame"}));
  // A body that WriteBvh wrote needs no remark.
  remarks.clear();
  const std::string body = Replaced(Replaced(text, "ROOT Hips", "ROOT hip_centre"), "JOINT Arm", "JOINT spine");
  ASSERT_TRUE(ReadBvh(Replaced(body, "    End Site\n    {\n      OFFSET 0 0 0\n    }\n", ""), "body.bvh", &remarks));
  EXPECT_THAT(remarks, ::testing::IsEmpty());
}

TEST(BvhHabits, IncludePlacesRelativeToTheOffset) {
  const std::string head = "HIERARCHY\nROOT a\n{\nOFFSET 0 9 0\nCHANNELS 3 Xposition Yposition Zposition\nJOINT b\n{\n"
                           "OFFSET 0 10 0\nCHANNELS 3 Xposition Yposition Zposition\nJOINT c\n{\nOFFSET 5 0 0\nCHANNELS 3 "
                           "Xposition Yposition Zposition\n}\n}\n}\nMOTION\nFrames: 2\nFrame Time: .1\n";
  std::vector<std::string> remarks;
  ASSERT_OK(relative, ReadBvh(head + "1 2 3 0 0 0 0 0 0\n1 2 3 0 .5 0 0 0 .1\n", "relative.bvh", &remarks));
  EXPECT_EQ(relative->frames[1][0].translation, glm::dvec3(1, 2, 3)) << "the root's places are the world's";
  EXPECT_EQ(relative->frames[1][1].translation, glm::dvec3(0, 10.5, 0));
  EXPECT_EQ(relative->frames[1][2].translation, glm::dvec3(5, 0, .1));
  EXPECT_EQ(remarks, (std::vector<std::string>{"the position channels are relative to the OFFSETs, so Etude added the "
                                               "OFFSETs"}));
  // The control: absolute positions replace OFFSETs, also for a joint that moves a little.
  ASSERT_OK(absolute, ReadBvh(head + "1 2 3 0 10 0 5 0 0\n1 2 3 0 10.5 0 5 0 .1\n", "absolute.bvh", &remarks));
  EXPECT_EQ(absolute->frames[1][1].translation, glm::dvec3(0, 10.5, 0));
  EXPECT_EQ(absolute->frames[1][2].translation, glm::dvec3(5, 0, .1));
  EXPECT_EQ(remarks.size(), 1u);
}

/// Returns the remarks on a file of `frames` frames with this frame time.
std::vector<std::string> RemarksOnFrameTime(const std::string& time, int frames, std::optional<double> told_hz = {}) {
  std::string text = Replaced(kSmallBvh, ".0083333", time);
  text = Replaced(text, "Frames: 2", "Frames: " + std::to_string(frames));
  for (int frame = 2; frame < frames; ++frame) text += "1 2 3 90 0 0 0 0 0\n";
  std::vector<std::string> remarks;
  const auto clip = ReadBvh(text, "a.bvh", &remarks, told_hz);
  EXPECT_TRUE(clip);
  EXPECT_NEAR(clip ? clip->rate_hz : 0, told_hz.value_or(1 / std::stod(time)), 1e-3);
  return remarks;
}

TEST(BvhHabits, FrameTimesOfFewDigitsAreTakenAndSaid) {
  // 1 / 30 s - 0.033 s = 1 / 3000 s, in 600 frames 0.2 s.
  EXPECT_EQ(RemarksOnFrameTime("0.033", 600),
            std::vector<std::string>{
                "the Frame Time 0.033 has few digits. Etude reads it as 30.303 Hz, but it may be 1 / 30 s, rounded. At "
                "30 Hz the 600 frames would last 0.2 s longer. Use `--rate 30` (for `etude clip convert`: "
                "`--file-rate`) to set this rate"});
  for (const auto& [time, likely] :
       {std::pair("0.017", "1 / 60 s, rounded. At 60 Hz the 600 frames would last 0.2 s sho"),
        {"0.016", "1 / 60 s, rounded. At 60 Hz the 600 frames would last 0.4 s longer"},
        {"0.0083", "1 / 120 s, rounded. At 120 Hz the 600 frames would last 0.02 s longer"},
        {"0.008", "1 / 120 s, rounded. At 120 Hz the 600 frames would last 0.2 s longer"},
        {"0.042", "1 / 24 s, rounded. At 24 Hz the 600 frames would last 0.2 s shorter"},
        {"0.0334", "it may be 1 / 29.97 s, rounded."},
        {"0.033000", "1 / 30 s, rounded. At 30 Hz the 600 frames would last 0.2 s longer"}}) {
    const auto remarks = RemarksOnFrameTime(time, 600);
    ASSERT_EQ(remarks.size(), 1u) << time;
    EXPECT_THAT(remarks[0], ::testing::HasSubstr(likely));
  }
  // The controls: usual rates and whole rates, enough digits, a drift of less than half a frame, and a stated rate.
  for (const char* time : {"0.04", "0.02", "0.05", "0.01", "0.1", "0.0125", "0.040000", "0.008000", "0.0333333",
                           ".0083333", "0.0333667", "0.041708"}) {
    EXPECT_THAT(RemarksOnFrameTime(time, 600), ::testing::IsEmpty()) << time;
  }
  EXPECT_THAT(RemarksOnFrameTime("0.0333", 400), ::testing::IsEmpty()) << "0.4 frames";
  EXPECT_EQ(RemarksOnFrameTime("0.0333", 600).size(), 1u) << "0.6 frames";
  EXPECT_THAT(RemarksOnFrameTime("0.033", 600, 30), ::testing::IsEmpty());
}

}  // namespace
}  // namespace etude
