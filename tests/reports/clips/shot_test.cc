#include "reports/clips/clip_film.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/reports/clips/clip_scene.h"

namespace etude {
namespace {

constexpr Box kBox{10, 20, 100, 140};

/// Whether all of a figure is seen within the box.
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
    Sight sight;
    shot.Include(frames, sight);
    const Studio studio(100, 140, 1, sight);
    for (const int frame : frames) EXPECT_TRUE(IsInside(studio, shot.PlacedFigure(frame))) << frame;
    // The control: not followed, it leaves.
    EXPECT_FALSE(IsInside(studio, Placed(actor.FigureAt(farthest - poses.begin()), shot.PlacementAt(0))));
  }
}

TEST(ShotTest, FromTheFrontLeftIsSeenOnTheRightAndTheSideShowsTheProfile) {
  const ClipActor actor = ActorOf("builtin:clap", ActorKind::kBody);
  Sight sight;
  const Shot front(actor, Viewpoint::kFront, 0), side(actor, Viewpoint::kSide, 0);
  front.Include({0}, sight);
  const Studio studio(100, 140, 1, sight);
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
