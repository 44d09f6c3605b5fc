#include "tools/clips/clip_film.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/retargeting/rig.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "sim/character/characters.h"
#include "sim/choreography/canonical_body.h"
#include "tests/tools/clips/clip_scene.h"

namespace etude {
namespace {

BodyPose WithArmsOut() {
  Controls controls;
  for (const Side side : {Side::kLeft, Side::kRight}) controls.Of(side, SideControl::kArmSide) = Radians(90);
  return PoseOf(controls);
}

/// Returns the largest distance between vertices of two figures, with `b` lifted.
double WorstVertex(const Figure& a, const Figure& b, double lift) {
  EXPECT_EQ(a.surfaces.size(), b.surfaces.size());
  int compared = 0;
  double worst = 0;
  for (std::size_t s = 0; s < a.surfaces.size(); ++s) {
    EXPECT_EQ(a.surfaces[s].positions.size(), b.surfaces[s].positions.size());
    for (std::size_t v = 0; v < a.surfaces[s].positions.size(); ++v, ++compared) {
      const glm::dvec3 lifted = b.surfaces[s].positions[v] + glm::dvec3(0, lift, 0);
      worst = std::max(worst, glm::distance(a.surfaces[s].positions[v], lifted));
    }
  }
  EXPECT_GT(compared, 1000);
  return worst;
}

TEST(ClipActorTest, AFilesOwnFigureIsWhereItsBodyIsAlsoAfterATPose) {
  // The built-in bear, written to a GLB file and drawn as that file's own figure, looks the same.
  const TemporaryFolder folder = *TemporaryFolder::Make("actor-test");
  const std::string path = (folder.path() / "bear.glb").string();
  const ClipActor bear = ActorOf("builtin:side_kick", ActorKind::kBear);
  const std::size_t moving = bear.motion().poses.size() / 8;
  for (const std::size_t t_poses : {0, 1, 3}) {
    BodyMotion motion = bear.motion();
    motion.poses.insert(motion.poses.begin(), t_poses, WithArmsOut());
    const Clip clip = RigClip(motion, StandingPose(), "side_kick");
    ASSERT_TRUE(WriteFileAtomically(path, WriteGlb(BearCharacter(), {&clip, 1})));
    const ClipActor own = ActorOf(path, ActorKind::kOwn);
    ASSERT_EQ(own.clip().body.dropped_frames, t_poses);
    ASSERT_EQ(own.motion().poses.size(), bear.motion().poses.size());
    // A file's floor is found under the lowest foot; a built-in clip's floor is known.
    const double lift = own.motion().poses[0][Role::kHead].y - bear.motion().poses[0][Role::kHead].y;
    EXPECT_LT(std::abs(lift), 0.05);
    for (const std::size_t frame : {std::size_t{0}, moving}) {
      EXPECT_LT(WorstVertex(own.FigureAt(frame), bear.FigureAt(frame), lift), 1e-3) << t_poses << " in front";
    }
    EXPECT_GT(WorstVertex(own.FigureAt(moving), bear.FigureAt(moving + 2), lift), 0.01) << "two frames later";
  }
}

TEST(ClipActorTest, WithoutAWishTheFigureFollowsFromTheClip) {
  EXPECT_TRUE(ClipActor::Make(Opened("builtin:clap"), std::nullopt)->FigureAt(0).shape.empty());
  const auto own = ClipActor::Make(Opened(kRealClip), ActorKind::kOwn);
  ASSERT_FALSE(own);
  EXPECT_THAT(own.error().message,
              ::testing::HasSubstr("the file contains no figure (meshes); allowed: bear, mannequin, body"));
}

TEST(ClipActorTest, TheBearKeepsItsProportionsAndTheMannequinTheActors) {
  const double thigh = BoneLength(Opened(kRealClip).body.motion.poses[0], {Role::kLeftHip, Role::kLeftKnee});
  const auto thigh_of = [](ActorKind kind) {
    return BoneLength(ActorOf(kRealClip, kind).motion().poses[0], {Role::kLeftHip, Role::kLeftKnee});
  };
  EXPECT_NEAR(thigh_of(ActorKind::kMannequin), thigh, 1e-9);
  EXPECT_GT(std::abs(thigh_of(ActorKind::kBear) - thigh), 0.005);
}

constexpr Box kBox{10, 20, 100, 140};

bool IsInside(const Studio& studio, const Figure& placed) {
  bool inside = true;
  for (const Capsule& capsule : placed.shape) {
    for (const glm::dvec3& point : {capsule.a, capsule.b}) {
      const glm::dvec2 pixel = studio.PixelOf(kBox, point);
      inside = inside && pixel.x > kBox.x && pixel.x < kBox.x + kBox.width && pixel.y > kBox.y &&
               pixel.y < kBox.y + kBox.height;
    }
  }
  return inside;
}

TEST(ShotTest, WhoeverWalksStaysInThePicture) {
  const ClipActor actor = ActorOf("/usr/share/assimp/models/BVH/01_01.bvh", ActorKind::kBody);
  const std::vector<BodyPose>& poses = actor.motion().poses;
  const auto way_to = [&](const BodyPose& pose) {
    return glm::distance(poses.front()[Role::kHipCentre], pose[Role::kHipCentre]);
  };
  const auto farthest = std::ranges::max_element(poses, {}, way_to);
  ASSERT_GT(way_to(*farthest), 1.0) << "it walks";
  for (const Viewpoint from : {Viewpoint::kFront, Viewpoint::kThreeQuarter, Viewpoint::kSide}) {
    const Shot shot(actor, from, 0);
    const std::vector<int> frames = SpreadFrames(shot, 9);
    ViewBounds bounds;
    shot.Include(frames, bounds);
    const Studio studio(100, 140, 1, bounds);
    for (const int frame : frames) EXPECT_TRUE(IsInside(studio, shot.PlacedFigure(frame))) << frame;
    // The control: a camera that does not follow loses it.
    EXPECT_FALSE(IsInside(studio, Placed(actor.FigureAt(farthest - poses.begin()), shot.PlacementAt(0))));
  }
}

TEST(ShotTest, FromTheFrontLeftIsSeenOnTheRightAndTheSideShowsTheProfile) {
  const ClipActor actor = ActorOf("builtin:clap", ActorKind::kBody);
  ViewBounds bounds;
  const Shot front(actor, Viewpoint::kFront, 0), side(actor, Viewpoint::kSide, 0);
  front.Include({0}, bounds);
  const Studio studio(100, 140, 1, bounds);
  const auto seen = [&](const Shot& shot, Role role) {
    return studio.PixelOf(kBox, shot.PlacementAt(0).Apply(actor.motion().poses[0][role]));
  };
  const double width = seen(front, Role::kLeftShoulder).x - seen(front, Role::kRightShoulder).x;
  EXPECT_GT(width, 5);
  EXPECT_LT(std::abs(seen(side, Role::kLeftShoulder).x - seen(side, Role::kRightShoulder).x), 0.5 * width);
  EXPECT_GT(seen(side, Role::kLeftFoot).x, seen(side, Role::kLeftAnkle).x) << "facing right";
  EXPECT_LT(seen(front, Role::kHead).y, seen(front, Role::kLeftFoot).y);
}

TEST(ShotTest, FramesAreSpreadFromTheFirstToTheLast) {
  const Shot shot(ActorOf("builtin:clap", ActorKind::kBody), Viewpoint::kFront, 0);
  const int last = shot.Frames() - 1;
  EXPECT_EQ(SpreadFrames(shot, 1), std::vector<int>{0});
  EXPECT_EQ(SpreadFrames(shot, 2), (std::vector<int>{0, last}));
  EXPECT_EQ(SpreadFrames(shot, 100000).size(), static_cast<std::size_t>(shot.Frames()));
}

}  // namespace
}  // namespace etude
