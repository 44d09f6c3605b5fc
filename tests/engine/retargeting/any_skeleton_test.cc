#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "engine/retargeting/map_file.h"
#include "tests/support/read_body.h"
#include "tests/support/results.h"

namespace etude {
namespace {

/// A small generator, so that every machine makes the same skeletons.
class Dice {
 public:
  std::uint32_t Below(std::uint32_t end) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::uint32_t>(state_ >> 33) % end;
  }
  double Number() { return (static_cast<double>(Below(2001)) - 1000) / 100; }

 private:
  std::uint64_t state_ = 7;
};

constexpr std::array kNames = {"Hips",         "LeftUpLeg", "LeftLeg", "LeftFoot",    "RightUpLeg", "RightLeg",
                               "RightFoot",    "Spine",     "LeftArm", "LeftForeArm", "LeftHand",   "RightArm",
                               "RightForeArm", "RightHand", "Neck",    "Head",        "rig:Neck",   "Head_End"};

/// Returns a clip of joints with a person's names and random offsets. Now and then a joint has another joint's name
/// or a random parent, or its offset or scale is zero.
Clip AnyClip(Dice& dice) {
  Clip clip{.name = "any", .skeleton = {}, .rate_hz = 30, .frames = {}};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const std::size_t name = dice.Below(40) == 0 ? dice.Below(kNames.size()) : i;
    const bool is_limb_start = i == 1 || i == 4 || i == 7 || i == 14;
    const bool is_arm_start = i == 8 || i == 11;
    int parent = is_limb_start ? 0 : is_arm_start ? 7 : static_cast<int>(i) - 1;
    if (dice.Below(30) == 0) parent = static_cast<int>(dice.Below(static_cast<std::uint32_t>(i + 1))) - 1;
    const double size = dice.Below(20) == 0 ? 0 : 1;
    clip.skeleton.joints.push_back(
        {.name = kNames[name],
         .parent = parent,
         .rest = {.translation = size * glm::dvec3(dice.Number(), dice.Number(), dice.Number()),
                  .scale = glm::dvec3(dice.Below(50) == 0 ? 0 : 1)},
         .is_end_site = name + 1 == kNames.size()});
  }
  for (int frame = 0; frame < 3; ++frame) {
    clip.frames.push_back(RestPose(clip.skeleton));
    for (LocalTransform& local : clip.frames.back()) {
      local.rotation = glm::angleAxis(dice.Number(), glm::normalize(glm::dvec3(dice.Number(), 1, dice.Number())));
    }
  }
  return clip;
}

TEST(AnySkeleton, IsRefusedOrGivesAFiniteBodyAndAMapThatReadsBack) {
  Dice dice;
  int understood = 0, unmapped = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    const Clip clip = AnyClip(dice);
    const auto map = FindJointMap(clip.skeleton, "any.bvh");
    if (!map) {
      ++unmapped;
      continue;
    }
    ASSERT_OK(taught, ReadJointMapFile(WriteJointMapFile(clip.skeleton, *map), "any.yaml"));
    ASSERT_OK(again, FindJointMap(clip.skeleton, "any.bvh", &*taught));
    for (const Role role : AllRoles()) {
      ASSERT_EQ((*again)[role].joint, (*map)[role].joint) << RoleName(role);
      ASSERT_EQ((*again)[role].offset, (*map)[role].offset) << RoleName(role);
    }
    const auto body = ToBodyMotion(clip, *map, "any.bvh");
    if (!body) {
      ++refused;
      continue;
    }
    ++understood;
    EXPECT_GT(body->metres_per_unit, 0);
    for (const BodyPose& pose : body->motion.poses) {
      for (const glm::dvec3& joint : pose.joints) ASSERT_TRUE(std::isfinite(glm::length(joint)));
    }
  }
  // All three ways occurred.
  EXPECT_GT(understood, 100);
  EXPECT_GT(unmapped, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace etude
