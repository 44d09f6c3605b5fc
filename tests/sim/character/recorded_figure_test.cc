#include "sim/character/recorded_figure.h"

#include <gtest/gtest.h>

#include <memory>

#include "engine/retargeting/rig.h"
#include "sim/character/characters.h"
#include "sim/character/posed.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/stance.h"

namespace etude {
namespace {

TEST(PartsOfJoints, ByTheMapAreThoseByNameOfASkeletonThatHasBoth) {
  const Skeleton skeleton = MannequinCharacter().skeleton;
  const auto map = FindJointMap(skeleton, "mannequin");
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(PartsOfJoints(skeleton, *map), PartsOfJoints(skeleton));
}

TEST(PartsOfJoints, BetweenNeckAndHeadAreHeadAndInsideALimbAreThatLimb) {
  Skeleton skeleton;
  for (const char* name : {"hips", "chest", "neck", "skull", "crown", "jaw", "arm", "twist", "elbow", "finger"}) {
    skeleton.joints.push_back({.name = name, .parent = static_cast<int>(skeleton.joints.size()) - 1, .rest = {}});
  }
  skeleton.joints[5].parent = 3;  // the jaw hangs from the skull
  skeleton.joints[6].parent = 1;  // the arm from the chest
  JointMap map;
  for (RolePoint& point : map.points) point.joint = 0;
  const auto at = [&map](Role role, int joint) { map.points[Index(role)].joint = joint; };
  at(Role::kSpine, 1);
  at(Role::kShoulderCentre, 2);
  at(Role::kHead, 4);
  at(Role::kLeftShoulder, 6);
  at(Role::kLeftElbow, 8);
  at(Role::kLeftWrist, 9);
  at(Role::kLeftHand, 9);
  const std::vector<Part> wanted{Part::kTrunk,       Part::kTrunk,   Part::kTrunk,        Part::kHead,
                                 Part::kHead,        Part::kHead,    Part::kLeftUpperArm, Part::kLeftUpperArm,
                                 Part::kLeftForearm, Part::kLeftHand};
  EXPECT_EQ(PartsOfJoints(skeleton, map), wanted);
}

TEST(RecordedFigure, IsTheCharacterInTheBodysPosesMovedAlongTheFloor) {
  const auto mannequin = std::make_shared<const Character>(MannequinCharacter());
  BodyMotion motion{.rate_hz = 30, .poses = {StandingPose(), PoseOf(ReadyStance()), StandingPose()}};
  Clip clip = RigClip(motion, StandingPose(), "ready");
  clip.skeleton = mannequin->skeleton;
  const auto map = FindJointMap(clip.skeleton, "ready");
  ASSERT_TRUE(map) << map.error().message;
  // The file's own rate is twice the body's, and its first two frames were dropped.
  clip.frames.insert(clip.frames.begin(), 2, clip.frames.front());
  clip.rate_hz = 60;
  BodyConversion body;
  body.metres_per_unit = 0.5;
  body.dropped_frames = 2;
  body.motion = motion;
  const RecordedFigure figure(mannequin, clip, *map, body);

  const FloorMove move{.yaw = 0.7, .x = 0.2, .z = -1};
  // Frame 1/2 of the motion is frame 2 + 1 of the file: the ready stance at half its size.
  const Figure seen = figure.At(0.5, move), wanted = PosedFigure(*mannequin, clip.frames[3]);
  ASSERT_EQ(seen.surfaces.size(), wanted.surfaces.size());
  for (std::size_t s = 0; s < seen.surfaces.size(); ++s) {
    for (std::size_t v = 0; v < seen.surfaces[s].positions.size(); ++v) {
      const glm::dvec3 there = move.Apply(0.5 * wanted.surfaces[s].positions[v]);
      ASSERT_LT(glm::distance(seen.surfaces[s].positions[v], there), 1e-9);
    }
  }
  for (std::size_t s = 0; s < seen.surfaces.size(); ++s) {
    EXPECT_TRUE(seen.surfaces[s].parts == wanted.surfaces[s].parts) << s;
  }
}

}  // namespace
}  // namespace etude
