#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "engine/formats/bvh.h"
#include "tests/engine/formats/small_bvh.h"
#include "tests/engine/formats/spoilt.h"
#include "tests/support/person.h"
#include "tests/support/random_clip.h"
#include "tests/support/read_body.h"
#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::IsFinite;
using ::testing::HasSubstr;
using testing::kSmallBvh;
using testing::Replaced;

struct Broken {
  const char* what;
  const char* from;
  const char* to;
  int line;
  int column;
  const char* complaint;
};

// clang-format off
constexpr Broken kBroken[] = {
    {"not BVH at all", "HIERARCHY", "solid cube", 1, 1, "found 'solid'; expected HIERARCHY"},
    {"no root", "ROOT Hips", "JOINT Hips", 2, 1, "found 'JOINT'; expected ROOT"},
    {"nameless root", "ROOT Hips", "ROOT ", 2, 6, "expected a joint's name"},
    {"unknown channel", "Yposition Zposition", "Yposition Zpos", 5, 34, "found 'Zpos'; expected 6 channels out of Xposition"},
    {"a channel twice", "Zrotation Xrotation Yrotation", "Zrotation Xrotation Zrotation", 5, 64, "channel Zrotation appears twice"},
    {"too many channels", "CHANNELS 6", "CHANNELS 7", 5, 12, "allowed: a whole number from 0 to 6"},
    {"fewer channels named than counted", "Zrotation Yrotation Xrotation", "Zrotation Yrotation", 10, 5, "found 'End'; expected 3 channels"},
    {"more channels named than counted", "CHANNELS 3", "CHANNELS 2", 9, 36, "found 'Xrotation'; expected OFFSET and CHANNELS"},
    {"offset twice", "    CHANNELS 3", "    OFFSET 1 2 3 CHANNELS 3", 9, 5, "found 'OFFSET'; expected OFFSET and CHANNELS (once each"},
    {"no offset", "    OFFSET 0 10 0\n", "\n", 14, 3, "every joint needs"},
    {"offset of two numbers", "OFFSET 0 10 0", "OFFSET 0 10", 9, 5, "found 'CHANNELS' as one of an OFFSET's three numbers"},
    {"end without site", "End Site", "End", 11, 5, "found '{'; expected Site"},
    {"end site with a child", "OFFSET 5 0 0", "OFFSET 5 0 0\n JOINT Finger", 13, 2, "found 'JOINT'; expected }"},
    {"missing opening brace", "JOINT Arm\n  {", "JOINT Arm\n", 8, 5, "found 'OFFSET'; expected {"},
    {"missing closing brace", "}\nMOTION", "MOTION", 15, 1, "found 'MOTION'; expected OFFSET and CHANNELS"},
    {"one closing brace too many", "}\nMOTION", "}}\nMOTION", 15, 2, "found '}'; expected MOTION"},
    {"second root", "MOTION", "ROOT Other", 16, 1, "found a second ROOT; allowed: one skeleton per file"},
    {"no number of frames", "Frames: 2", "Frames: many", 17, 9, "found 'many' as the number of frames"},
    {"no frames", "Frames: 2", "Frames: 0", 17, 9, "found '0' frames; allowed: a whole number from 1"},
    {"half a frame", "Frames: 2", "Frames: 1.5", 17, 9, "allowed: a whole number from 1"},
    {"more frames than memory", "Frames: 2", "Frames: 900000000", 17, 9, "900000000 frames of 3 joints take 216000 MB; allowed: 1000 MB"},
    {"fewer frames than announced", "Frames: 2", "Frames: 3", 17, 9, "3 frames announced; the file contains 2"},
    {"more frames than announced", "Frames: 2\nFrame Time: .0083333", "Frames: 1\nFrame Time: .0083333\n1 2 3 0 0 0 0 0 0", 21, 1, "more lines than the 1 frames announced on line 17"},
    {"frame time of zero", ".0083333", "0", 18, 13, "found a frame time of 0 s; allowed: 0.0001 to 10 s"},
    {"negative frame time", ".0083333", "-.01", 18, 13, "found a frame time of -.01 s"},
    {"frame time without a name", "Frame Time", "Rate", 18, 1, "found 'Rate'; expected 'Frame'"},
    {"first frame behind the frame time", ".0083333\n", ".0083333 ", 18, 22, "found '1' after the frame time"},
    {"too few numbers", "1 2 3 90 0 0 0 0 0", "1 2 3 90 0 0 0 0", 19, 17, "frame 1 has 8 numbers; its 9 channels need 9"},
    {"too many numbers", "1 2 3 0 0 0 90 0 0", "1 2 3 0 0 0 90 0 0 4", 20, 20, "frame 2 continues with '4' after its 9 numbers"},
    {"a frame on two lines", "1 2 3 90 0 0 0 0 0", "1 2 3 90\n0 0 0 0 0", 19, 9, "frame 1 has 4 numbers; its 9 channels need 9"},
    {"two frames on one line", "1 2 3 90 0 0 0 0 0\n", "1 2 3 90 0 0 0 0 0 ", 19, 20, "frame 1 continues with '1' after its 9 numbers"},
    {"a comma for the decimal point", "1 2 3 90", "1 2,5 3 90", 19, 3, "found '2,5' as a channel's value"},
    {"a comment", "HIERARCHY", "# made by hand\nHIERARCHY", 1, 1, "found '#'; expected HIERARCHY"},
    {"a word among the numbers", "1 2 3 90", "1 2 x 90", 19, 5, "found 'x' as a channel's value; allowed: a number"},
    {"Windows' way to print NaN", "1 2 3 90", "1 2 -1.#IND00 90", 19, 5, "found '-1.#IND00' as a channel's value"},
    {"not a number", "1 2 3 90", "1 2 nan 90", 19, 5, "found 'nan'"},
    {"infinite", "1 2 3 90", "1 2 -inf 90", 19, 5, "found '-inf'"},
    {"beyond any double", "1 2 3 90", "1 2 1e999 90", 19, 5, "found '1e999'"},
    {"beyond sense", "1 2 3 90", "1 2 1e10 90", 19, 5, "a number within ±1e+09"},
};
// the control: the undamaged file is read

TEST(BrokenBvh, IsRefusedWithLineColumnAndWhatIsAllowed) {
  ASSERT_TRUE(ReadBvh(kSmallBvh, "small.bvh"));  // the control: unbroken, it reads
  for (const Broken& broken : kBroken) {
    SCOPED_TRACE(broken.what);
    const auto clip = ReadBvh(Replaced(kSmallBvh, broken.from, broken.to), "broken.bvh");
    ASSERT_FALSE(clip);
    EXPECT_EQ(ToString(clip.error().place), fmt::format("broken.bvh:{}:{}", broken.line, broken.column));
    EXPECT_THAT(clip.error().message, HasSubstr(broken.complaint));
  }
}

TEST(BrokenBvh, IsRefusedWhenItEndsAnywhereEarly) {
  // Anything before the last number of the last frame is needed; after it only the line's end.
  const std::size_t needed = kSmallBvh.find_last_of('0');
  for (std::size_t length = 0; length < needed; ++length) {
    EXPECT_FALSE(ReadBvh(kSmallBvh.substr(0, length), "cut.bvh")) << length;
  }
  EXPECT_TRUE(ReadBvh(kSmallBvh.substr(0, needed + 1), "cut.bvh"));
}

std::string Nested(int joints) {
  std::string text = "HIERARCHY\nROOT a\n";
  for (int i = 1; i < joints; ++i) text += "{ OFFSET 0 0 0 CHANNELS 1 Xrotation\nJOINT a\n";
  text += "{ OFFSET 0 0 0 CHANNELS 1 Xrotation ";
  text += std::string(joints, '}') + "\nMOTION\nFrames: 1\nFrame Time: 1\n";
  for (int i = 0; i < joints; ++i) text += "0 ";
  return text;
}

TEST(BrokenBvh, IsRefusedWhenNestedDeeperThanAnyBody) {
  EXPECT_TRUE(ReadBvh(Nested(128), "deep.bvh"));
  EXPECT_EQ(testing::Refusal(ReadBvh(Nested(129), "deep.bvh")),
            "deep.bvh:258:7: joints nested more than 128 levels deep");
}

TEST(BrokenBvh, IsRefusedWithMoreJointsThanAnyBody) {
  std::string text = "HIERARCHY\nROOT a\n{ OFFSET 0 0 0 CHANNELS 1 Xrotation\n";
  for (int i = 0; i < 1024; ++i) text += "End Site { OFFSET 0 1 0 }\n";
  EXPECT_EQ(testing::Refusal(ReadBvh(text, "wide.bvh")), "wide.bvh:1027:1: more than 1024 joints and end sites");
}

TEST(BrokenBvh, IsRefusedForNamesThatAreNone) {
  const auto named = [](std::size_t length) {
    return Replaced(kSmallBvh, "ROOT Hips", "ROOT " + std::string(length, 'x'));
  };
  EXPECT_TRUE(ReadBvh(named(500), "long.bvh"));
  EXPECT_EQ(testing::Refusal(ReadBvh(named(501), "long.bvh")),
            "long.bvh:2:6: a joint's name of 501 bytes; allowed: 500");
}

TEST(BrokenBvh, ShowsOnlyPrintableAndShortWordsInComplaints) {
  EXPECT_EQ(testing::Message(ReadBvh(std::string("\x01\xFF") + std::string(5000, 'x'), "binary.bvh")),
            "found '??" + std::string(38, 'x') + "…'; expected HIERARCHY");
}

TEST(BrokenBvh, NeverGivesABodyThatIsNotFiniteWhenBytesChange) {
  Clip person = testing::AtRest(testing::PersonSkeleton(), 2);
  testing::LowerArms(person, 1);
  const std::string text = WriteBvh(person);
  int converted = 0, refused = 0;
  for (const std::string& spoilt : testing::SpoiltTexts(text, 2, 1000)) {
    const auto body = testing::ReadBody(spoilt, "spoilt.bvh");
    if (!body) {
      ++refused;
      continue;
    }
    ++converted;
    for (const BodyPose& pose : body->motion.poses) {
      for (const glm::dvec3& joint : pose.joints) ASSERT_TRUE(IsFinite(joint));
    }
  }
  EXPECT_GT(converted, 50);
  EXPECT_GT(refused, 200);
}

}  // namespace
}  // namespace etude
