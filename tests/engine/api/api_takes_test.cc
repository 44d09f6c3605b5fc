// The library's silhouettes and transitions are the engine's to the last bit; what the engine only asserts is refused.
#include <etude/silhouettes.h>
#include <etude/transitions.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/fuzzy/features.h"
#include "engine/silhouettes/track_silhouettes.h"
#include "engine/transitions/choices/choice.h"
#include "tests/engine/silhouettes/swinging_take.h"

namespace etude::engine {
namespace {

using ::testing::HasSubstr;

std::string RefusalOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

/// A body that was ray cast into two cameras of 160 × 120 pixels.
struct SmallTake {
  std::vector<Camera> cameras;
  std::vector<std::vector<PersonMask>> masks;
  std::vector<ProjectionMatrix> matrices;  ///< to pictures four times as large, which the options are made for
  std::vector<std::vector<Silhouette>> silhouettes;

  SmallTake() {
    const SilhouetteBody body = MakeSilhouetteBody({});
    for (etude::Camera small : CamerasAround({-40, 40})) {
      small.intrinsics = {.width = 160, .height = 120, .fx = 150, .fy = 150, .cx = 80, .cy = 60};
      etude::Camera large = small;
      large.intrinsics = {.width = 640, .height = 480, .fx = 600, .fy = 600, .cx = 320, .cy = 240};
      matrices.push_back(MatrixOf(large));
      Camera& camera = cameras.emplace_back();
      camera.width = 160, camera.height = 120, camera.fx = camera.fy = 150, camera.cx = 80, camera.cy = 60;
      camera.R_CW = small.R_CW;
      camera.p_WC = small.p_WC;
      masks.emplace_back();
      silhouettes.emplace_back();
      for (int k = 0; k < 4; ++k) {
        const Mask mask = RayCast(body, Swinging(body, 0.4 * k), small);
        masks.back().push_back({160, 120, mask.pixels});
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
  EXPECT_LT(glm::distance((*poses[0])[Role::kHipCentre], truth[etude::Role::kHipCentre]), 0.05);
}

TEST(ApiSilhouettes, TellsTheRimOfAMask) {
  PersonMask mask{20, 10, std::vector<std::uint8_t>(200)};
  for (int y = 2; y < 8; ++y) {
    for (int x = 5; x < 15; ++x) mask.pixels[20 * y + x] = 255;
  }
  const std::vector<float> distances = SignedDistances(mask);
  EXPECT_EQ(distances[20 * 2 + 5], -0.5f);
  EXPECT_EQ(distances[20 * 2 + 4], 0.5f);
  EXPECT_EQ(distances[20 * 5 + 19], 4.5f);
  const auto rim = Outline(mask, {.spacing = 1, .thinnest = 0});
  EXPECT_GT(rim.size(), 20u);
  for (const OutlinePoint& point : rim) {
    const double x = std::min(std::abs(point.pixel.x - 5), std::abs(point.pixel.x - 15));
    const double y = std::min(std::abs(point.pixel.y - 2), std::abs(point.pixel.y - 8));
    EXPECT_LT(std::min(x, y), 0.71) << point.pixel.x << " " << point.pixel.y;
    EXPECT_GT(glm::dot(point.normal, point.pixel - glm::dvec2(10, 5)), 0);
  }
  EXPECT_TRUE(Outline({20, 10, std::vector<std::uint8_t>(200)}).empty());
}

TEST(ApiSilhouettes, RefusesWhatDoesNotGoTogether) {
  EXPECT_THAT(RefusalOf([] { Outline({}); }), HasSubstr("0 x 0 pixels"));
  EXPECT_THAT(RefusalOf([] { SignedDistances({2, 2, {1}}); }), HasSubstr("a mask of 1 pixels; allowed: 2 x 2"));
  std::vector<Camera> cameras(2);
  const std::vector<std::vector<PersonMask>> masks(2, {{640, 480, std::vector<std::uint8_t>(640 * 480)}});
  EXPECT_FALSE(TrackSilhouettes(cameras, masks).front());
  const auto refused = [&](const SilhouetteOptions& options = {}) {
    return RefusalOf([&] { TrackSilhouettes(cameras, masks, options); });
  };
  EXPECT_THAT(refused({.stature_m = 3}), HasSubstr("allowed: 0.5 to 2.5"));
  EXPECT_THAT(refused({.measured = {Pose{}}}), HasSubstr("a limb has no length"));
  cameras[1].width = 641;
  EXPECT_THAT(refused(), HasSubstr("640 x 480 pixels of camera ''; allowed: its 641 x 480"));
  cameras[1].k1 = 0.1;
  EXPECT_THAT(refused(), HasSubstr("a lens with distortion"));
  cameras.pop_back();
  EXPECT_THAT(refused(), HasSubstr("1 cameras, but masks of 2"));
}

/// A standing body that sways, `far` metres to each side.
Motion Swaying(int frames, double far) {
  const SilhouetteBody body = MakeSilhouetteBody({});
  const BodyPose standing = ToBodyPose(body, Swinging(body, 0));
  Motion motion;
  for (int i = 0; i < frames; ++i) {
    Pose& pose = motion.poses.emplace_back(Pose{standing.joints});
    for (glm::dvec3& joint : pose.joints) joint.x += far * joint.y * std::sin(0.2 * i);
  }
  return motion;
}

TEST(ApiTransitions, ShowsWhatTheEngineShowsToTheLastBit) {
  const std::vector<Motion> clips = {Swaying(90, 0.05), Swaying(80, 0.08)};
  const TransitionLibrary library(clips);
  std::vector<BodyMotion> motions;
  for (const Motion& clip : clips) {
    BodyMotion& motion = motions.emplace_back();
    for (const Pose& pose : clip.poses) motion.poses.push_back({pose.joints});
  }
  const BodyPose& first = motions.front().poses.front();
  const MotionLibrary wanted = MakeLibrary({"a", "b"}, motions, MakeBodyProportions(first, StandingHipHeight(first)));
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
  std::vector<Motion> clips = {Swaying(30, 0.05), Swaying(1, 0)};
  EXPECT_THAT(RefusalOf([&] { TransitionLibrary{clips}; }),
              HasSubstr("clip 1: 1 frames at 30 Hz; allowed: two or more"));
  clips.pop_back();
  const TransitionLibrary library(clips);
  EXPECT_THAT(RefusalOf([&] { library.Make(0, 30, 0); }), HasSubstr("frame 30 of clip 0; allowed: 0 to 29"));
  EXPECT_THAT(RefusalOf([&] { library.Make(0, 0, 1); }), HasSubstr("clip 1; allowed: 0 to 0"));
  EXPECT_THAT(RefusalOf([&] { library.Make(0, 0, 0, -1); }), HasSubstr("a budget of -1 s"));
  EXPECT_THAT(RefusalOf([&] { library.Make(0, 0, 0, 1, {.choice = "?"}); }), HasSubstr("choice '?'; allowed: fuzzy-"));
  EXPECT_THAT(RefusalOf([&] { library.Make(0, 0, 0, 1, {.join = "?"}); }), HasSubstr("join '?'; allowed: cut"));
  EXPECT_THAT(RefusalOf([&] { library.Make(0, 0, 0, 1, {.threshold = std::nan("")}); }), HasSubstr("threshold nan"));
}

}  // namespace
}  // namespace etude::engine
