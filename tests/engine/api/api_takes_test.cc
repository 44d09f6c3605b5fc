// The library's silhouettes and transitions equal the engine's to the last bit. Where the engine only asserts, the
// library refuses with a reason.
#include <etude/silhouettes.h>
#include <etude/transitions.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/silhouettes/track_silhouettes.h"
#include "engine/transitions/choices/choice.h"
#include "tests/engine/silhouettes/swinging_take.h"
#include "tests/support/refusal.h"

namespace etude::engine {
namespace {

using etude::testing::RefusalOf;
using ::testing::HasSubstr;

struct SmallTake {
  std::vector<NamedCamera> cameras;
  std::vector<std::vector<Mask>> masks;
  std::vector<ProjectionMatrix> matrices;  ///< for pictures four times as large, which the default options expect
  std::vector<std::vector<Silhouette>> silhouettes;

  SmallTake() {
    const SilhouetteBody body = MakeSilhouetteBody({});
    for (Camera small : CamerasAround({-40, 40})) {
      small.intrinsics = {.width = 160, .height = 120, .fx = 150, .fy = 150, .cx = 80, .cy = 60};
      Camera large = small;
      large.intrinsics = {.width = 640, .height = 480, .fx = 600, .fy = 600, .cx = 320, .cy = 240};
      matrices.push_back(MatrixOf(large));
      cameras.push_back({"", small});
      masks.emplace_back();
      silhouettes.emplace_back();
      for (int k = 0; k < 4; ++k) {
        const Mask& mask = masks.back().emplace_back(RayCast(body, Swinging(body, 0.4 * k), small));
        silhouettes.back().push_back(MakeSilhouette(mask, {.mask_pixel = 4}));
      }
    }
  }
};

TEST(ApiSilhouettes, FollowsABodyAsTheEngineDoesToTheLastBit) {
  const SmallTake take;
  const auto poses = TrackSilhouettes(take.cameras, take.masks);
  const SilhouetteTrack wanted =
      etude::TrackSilhouettes(MakeSilhouetteBody({}), {take.matrices, take.silhouettes, std::nullopt});
  ASSERT_EQ(poses.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    ASSERT_TRUE(poses[k]);
    EXPECT_EQ(poses[k]->joints, ToBodyPose(wanted.body, wanted.frames[k]->state).joints) << k;
  }
  const SilhouetteBody body = MakeSilhouetteBody({});
  const BodyPose truth = ToBodyPose(body, Swinging(body, 0));
  EXPECT_LT(glm::distance((*poses[0])[Role::kHipCentre], truth[Role::kHipCentre]), 0.05);
}

TEST(ApiSilhouettes, RefusesWhatDoesNotGoTogether) {
  std::vector<NamedCamera> cameras(2);
  std::vector<std::vector<Mask>> masks(2, {Mask(640, 480)});
  EXPECT_FALSE(TrackSilhouettes(cameras, masks).front());
  const auto refused = [&](const FollowOptions& options = {}) {
    return RefusalOf([&] { TrackSilhouettes(cameras, masks, options); });
  };
  EXPECT_THAT(refused({.measured = {Pose{}}}), HasSubstr("a limb of the poses in 'measured' has no length"));
  masks[0][0].pixels.pop_back();
  EXPECT_THAT(refused(), HasSubstr("the mask has 307199 pixels; allowed: 640 x 480"));
  masks[0] = masks[1];
  cameras.pop_back();
  EXPECT_THAT(refused(), HasSubstr("found 1 cameras, but masks for 2 cameras"));
}

/// Returns a standing body that sways by `far` metres to each side.
Motion Swaying(int frames, double far) {
  const SilhouetteBody body = MakeSilhouetteBody({});
  const BodyPose standing = ToBodyPose(body, Swinging(body, 0));
  Motion motion;
  for (int i = 0; i < frames; ++i) {
    Pose& pose = motion.poses.emplace_back(standing);
    for (glm::dvec3& joint : pose.joints) joint.x += far * joint.y * std::sin(0.2 * i);
  }
  return motion;
}

TEST(ApiTransitions, ShowsWhatTheEngineShowsToTheLastBit) {
  const std::vector<Motion> clips = {Swaying(90, 0.05), Swaying(80, 0.08)};
  const TransitionLibrary library(clips);
  const MotionLibrary wanted = MakeLibrary({"a", "b"}, clips, MedianProportions(clips.front().poses));
  for (const std::string& choice : TransitionChoices()) {
    for (const std::string join : {"cut", "planted-feet"}) {
      const Transition made = library.Make(0, 20, 1, 1, {.choice = choice, .join = join});
      const etude::Transition engine = MakeTransition(wanted, {.from = 0, .request_frame = 20, .to = 1},
                                                      {.choice = FindChoice(choice), .join = FindJoin(join)});
      ASSERT_EQ(made.motion.poses.size(), engine.splice.motion.poses.size()) << choice;
      for (std::size_t i = 0; i < made.motion.poses.size(); ++i) {
        ASSERT_EQ(made.motion.poses[i].joints, engine.splice.motion.poses[i].joints) << choice << i;
      }
      EXPECT_EQ(made.points.size(), engine.splice.points.size());
      EXPECT_EQ(made.wait_s, engine.record.wait_s);
      EXPECT_EQ(made.branch, BranchName(engine.record.branch));
    }
  }
  EXPECT_GT(library.Make(0, 20, 1).motion.poses.size(), 60u);
}

TEST(ApiTransitions, RefusesWhatThereIsNot) {
  EXPECT_THAT(RefusalOf([] { TransitionLibrary({}); }), HasSubstr("no clips"));
  const TransitionLibrary library(std::vector{Swaying(30, 0.05)});
  EXPECT_THAT(RefusalOf([&] { library.Make(0, 0, 0, 1, {.choice = "?"}); }), HasSubstr("choice '?'; allowed: fuzzy-"));
  EXPECT_THAT(RefusalOf([&] { library.Make(0, 0, 0, 1, {.join = "?"}); }), HasSubstr("join '?'; allowed: cut"));
  EXPECT_THAT(RefusalOf([&] { library.Make(0, 0, 0, 1, {.threshold = std::nan("")}); }), HasSubstr("threshold is nan"));
}

}  // namespace
}  // namespace etude::engine
