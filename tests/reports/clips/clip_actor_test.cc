#include "reports/clips/clip_actor.h"

#include <gmock/gmock.h>

#include "bench/clips/convert.h"
#include "bench/files/files.h"
#include "bench/files/temporary_folder.h"
#include "tests/reports/clips/clip_scene.h"

namespace etude {
namespace {

TEST(ClipActorTest, AFilesOwnFigureIsWhereItsBodyIs) {
  // The bear goes through a GLB file and is drawn as that file's own figure: the very bear again.
  const TemporaryFolder folder = *TemporaryFolder::Make("actor-test");
  const std::string path = (folder.path() / "bear.glb").string();
  ConvertOptions options;
  options.performer = Performer::kBear;
  const auto glb = ConvertClips(*ReadClips("builtin:side_kick"), MotionFormat::kGlb, options);
  ASSERT_TRUE(glb && WriteFileAtomically(path, glb->bytes));

  const ClipActor own = ActorOf(path, ActorKind::kOwn);
  const ClipActor bear = ActorOf("builtin:side_kick", ActorKind::kBear);
  ASSERT_EQ(own.motion().poses.size(), bear.motion().poses.size());
  // A file's floor is found under the lowest foot, a built-in clip's is known.
  const double lift = own.motion().poses[0][Role::kHead].y - bear.motion().poses[0][Role::kHead].y;
  EXPECT_LT(std::abs(lift), 0.05);
  int compared = 0;
  double worst = 0;
  for (const std::size_t frame : {std::size_t{0}, own.motion().poses.size() / 2}) {
    const Figure a = own.FigureAt(frame), b = bear.FigureAt(frame);
    ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
    for (std::size_t s = 0; s < a.surfaces.size(); ++s) {
      ASSERT_EQ(a.surfaces[s].positions.size(), b.surfaces[s].positions.size());
      for (std::size_t v = 0; v < a.surfaces[s].positions.size(); ++v, ++compared) {
        const glm::dvec3 lifted = b.surfaces[s].positions[v] + glm::dvec3(0, lift, 0);
        worst = std::max(worst, glm::distance(a.surfaces[s].positions[v], lifted));
      }
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_LT(worst, 1e-3);
}

TEST(ClipActorTest, WithoutAWishTheFigureFollowsFromTheClip) {
  EXPECT_TRUE(ClipActor::Make(Opened("builtin:clap"), std::nullopt)->FigureAt(0).shape.empty());
  const auto own = ClipActor::Make(Opened(kRealClip), ActorKind::kOwn);
  ASSERT_FALSE(own);
  EXPECT_THAT(own.error().message, ::testing::HasSubstr("has no figure of its own; allowed: bear, mannequin, body"));
}

TEST(ClipActorTest, TheBearKeepsItsProportionsAndTheMannequinTheActors) {
  const double thigh = BoneLength(Opened(kRealClip).body.motion.poses[0], {Role::kLeftHip, Role::kLeftKnee});
  const auto thigh_of = [](ActorKind kind) {
    return BoneLength(ActorOf(kRealClip, kind).motion().poses[0], {Role::kLeftHip, Role::kLeftKnee});
  };
  EXPECT_NEAR(thigh_of(ActorKind::kMannequin), thigh, 1e-9);
  EXPECT_GT(std::abs(thigh_of(ActorKind::kBear) - thigh), 0.005);
}

}  // namespace
}  // namespace etude
