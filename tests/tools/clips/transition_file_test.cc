#include "tools/clips/transition_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "io/clips/clip_library.h"
#include "io/files/temporary_folder.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

/// Returns the gap of two poses, each moved vertically until its lowest joint is on the floor, as in a library.
double LevelGap(BodyPose a, BodyPose b) {
  for (BodyPose* pose : {&a, &b}) {
    double low = 1e9;
    for (const glm::dvec3& joint : pose->joints) low = std::min(low, joint.y);
    for (glm::dvec3& joint : pose->joints) joint.y -= low;
  }
  return PoseGap(a, b);
}

class TransitionFileTest : public ::testing::Test {
 protected:
  TransitionFileOptions Groove() const {
    TransitionFileOptions options;
    options.from = "builtin:groove";
    options.to = "builtin:clap";
    options.at_s = 1;
    options.output = (folder_.path() / "out.bvh").string();
    return options;
  }
  TemporaryFolder folder_ = TemporaryFolder::Make("transition").value();
};

TEST_F(TransitionFileTest, BeginsAsTheFirstClipAndEndsAsTheSecond) {
  ASSERT_OK(made, WriteTransition(Groove()));
  ASSERT_NE(made->branch, Branch::kNone);
  EXPECT_LE(made->wait_s, 1 + 1e-9);
  EXPECT_GE(made->left_s, 1 - 1.0 / 30);
  ASSERT_OK(whole, LoadClips({Groove().output}, {}));
  const BodyMotion& motion = whole->clips[0].motion;
  EXPECT_NEAR(motion.DurationSeconds() - 1.0 / 30, made->duration_s, 1e-6);
  const auto from = LoadClips({"builtin:groove"}, {}).value(), to = LoadClips({"builtin:clap"}, {}).value();
  EXPECT_LT(LevelGap(motion.poses.front(), from.clips[0].motion.poses.front()), 0.01);
  EXPECT_LT(LevelGap(motion.poses[20], from.clips[0].motion.poses[20]), 0.01);
  EXPECT_LT(LevelGap(motion.poses.back(), to.clips[0].motion.poses.back()), 0.01);
  EXPECT_GT(LevelGap(motion.poses[20], to.clips[0].motion.poses.back()), 0.01) << "the control";
}

TEST_F(TransitionFileTest, SaysWhatIsWrong) {
  TransitionFileOptions options = Groove();
  options.at_s = 99;
  EXPECT_THAT(WriteTransition(options).error().message,
              HasSubstr("--at 99: outside the clip builtin:groove; allowed: 0.00 to "));
  options = Groove();
  options.output = "out.xyz";
  EXPECT_THAT(ToString(WriteTransition(options).error()),
              HasSubstr("out.xyz: Etude cannot write files with this ending"));
  options = Groove();
  options.to = "builtin:nothing";
  EXPECT_FALSE(WriteTransition(options));
}

}  // namespace
}  // namespace etude
