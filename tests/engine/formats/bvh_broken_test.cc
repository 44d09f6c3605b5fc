#include <gtest/gtest.h>

#include <string>

#include "engine/formats/bvh.h"
#include "tests/engine/formats/small_bvh.h"
#include "tests/engine/formats/spoilt.h"
#include "tests/support/kept_answers.h"
#include "tests/support/person.h"
#include "tests/support/random_clip.h"
#include "tests/support/read_body.h"
#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::IsFinite;
using testing::kSmallBvh;
using testing::Replaced;

TEST(BrokenBvh, IsRefusedWithLineColumnAndWhatIsAllowed) {
  ASSERT_TRUE(ReadBvh(kSmallBvh, "a.bvh"));  // the control: unbroken, it reads
  const auto refusal = [](const std::string& edit) {
    return testing::Refusal(ReadBvh(testing::Edited(std::string(kSmallBvh), edit), "a.bvh"));
  };
  EXPECT_TRUE(testing::AnswersAreKept("tests/engine/formats/bvh_broken.txt", refusal));
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
            "long.bvh:2:6: a joint's name has 501 bytes; allowed: at most 500");
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
