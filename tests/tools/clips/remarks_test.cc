#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engine/motion/standing_body.h"
#include "tools/clips/clip_facts.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The standing body on its back, 10 cm of it below its joints.
BodyPose Lying() {
  BodyPose pose = Standing();
  for (glm::dvec3& joint : pose.joints) joint = {joint.x, 0.1 + joint.z, joint.y};
  return pose;
}

/// A body, standing unless another is told, for three seconds, lifted by `height` metres from `from` to `to`, seconds,
/// moving at `speed`.
std::vector<std::string> RemarksOnLifted(double height, double from, double to, double speed = 0,
                                         const BodyPose& body = Standing()) {
  BodyMotion motion{.rate_hz = 30, .poses = {}};
  for (int f = 0; f < 90; ++f) {
    BodyPose pose = body;
    const bool is_lifted = f >= 30 * from && f < 30 * to;
    for (glm::dvec3& joint : pose.joints) joint += glm::dvec3(speed * f / 30, is_lifted ? height : 0, 0);
    motion.poses.push_back(pose);
  }
  return RemarksOn(motion, ComputeStatistics(motion));
}

TEST(Remarks, AreNoneOnWhatPeopleDo) {
  EXPECT_THAT(RemarksOnLifted(0, 0, 0), IsEmpty());
  EXPECT_THAT(RemarksOnLifted(0.5, 0.5, 1.3), IsEmpty()) << "a jump";
  EXPECT_THAT(RemarksOnLifted(0.08, 0.5, 3), IsEmpty()) << "a floor found somewhat too low";
  EXPECT_THAT(RemarksOnLifted(0.2, 0.5, 2.4), IsEmpty()) << "a step up and down";
  EXPECT_THAT(RemarksOnLifted(0.35, 0.5, 3, 0, Lying()), IsEmpty()) << "on a couch";
  EXPECT_THAT(RemarksOnLifted(-0.04, 0.5, 1.3), IsEmpty()) << "feet are soft";
  EXPECT_THAT(RemarksOnLifted(0, 0, 0, 9), IsEmpty()) << "a sprint";
}

TEST(Remarks, AreMadeOnWhatNobodyDoes) {
  EXPECT_THAT(RemarksOnLifted(0, 0, 0, 17),
              ElementsAre("the fastest joint moves at 17.0 m/s in the median frame; is the frame time right?"));
  EXPECT_THAT(RemarksOnLifted(-0.12, 1, 1.2),
              ElementsAre("left_foot is 12 cm below the floor at 1.00 s; 7 % of the frames are over 5 cm deep"));
  EXPECT_THAT(RemarksOnLifted(0.3, 0.5, 1.7),
              ElementsAre(HasSubstr("no joint is within 25 cm of the floor for 1.2 s")));
  EXPECT_THAT(RemarksOnLifted(0.1, 0.5, 3),
              ElementsAre(HasSubstr("no joint is within 9 cm of the floor for 2.5 s from 0.50 s on")));
  EXPECT_THAT(RemarksOnLifted(0.6, 0.5, 3, 0, Lying()), ElementsAre(HasSubstr("no joint is within 50 cm")));
}

TEST(Remarks, TellHowFarAJointSlides) {
  BodyMotion motion{.rate_hz = 30, .poses = {}};
  for (int f = 0; f < 60; ++f) motion.poses.push_back(Standing());
  const RestBody rest = RestBodyOf(motion.poses);
  EXPECT_EQ(RemarkOnSliding(motion, rest), std::nullopt);
  for (std::size_t f = 0; f < 60; f += 2) motion.poses[f][Role::kHead].y += 0.02;
  const auto told = RemarkOnSliding(motion, rest);
  ASSERT_TRUE(told);
  EXPECT_THAT(*told, testing::StartsWith("joints slide: a skeleton that keeps its lengths stays "));
  EXPECT_THAT(*told, testing::EndsWith("mm at 0.00 s (head)"));
}

}  // namespace
}  // namespace etude
