#include "bench/tasks/capture/nearest_poses.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "io/clips/clip_library.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

/// The errors of the poses that FindNearestPoses returns, as means over all frames: of the joint with the largest mean
/// error, and of the limb with the largest mean error.
struct Distance {
  double joint_mm = 0, limb_deg = 0;
};

Distance DistanceOf(const CaptureBody& body, const std::vector<BodyPose>& truth) {
  const std::vector<TreeState> nearest = FindNearestPoses(body, truth);
  std::array<double, kRoleCount> joint_mm{}, limb_deg{};
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const BodyPose pose = ToBodyPose(body, nearest[k]);
    const double share = 1.0 / static_cast<double>(truth.size());
    for (const Role role : AllRoles())
      joint_mm[Index(role)] += 1000 * share * glm::distance(pose[role], truth[k][role]);
    for (const Bone& bone : AllBones()) {
      const glm::dvec3 found = pose[bone.child] - pose[bone.parent],
                       real = truth[k][bone.child] - truth[k][bone.parent];
      limb_deg[Index(bone.child)] += share * Degrees(AngleBetween(found, real));
    }
  }
  return {std::ranges::max(joint_mm), std::ranges::max(limb_deg)};
}

LibraryClip ClipNamed(const std::string& reference) {
  auto clips = LoadClips({reference}, {});
  EXPECT_TRUE(clips) << ToString(clips.error());
  LibraryClip clip = std::move(clips->clips.front());
  // Every sixth frame gives the same result.
  std::vector<BodyPose> some;
  for (std::size_t k = 0; k < clip.motion.poses.size(); k += 6) some.push_back(clip.motion.poses[k]);
  clip.motion.poses = std::move(some);
  return clip;
}

class NearestPoses : public ::testing::TestWithParam<std::string> {};

TEST_P(NearestPoses, OfTheFittedBodyAreTheTruthAndOfPaperBsAreNot) {
  const LibraryClip clip = ClipNamed(GetParam());
  ASSERT_OK(fitted, FittedBody(clip.body));
  const Distance left = DistanceOf(*fitted, clip.motion.poses);
  EXPECT_LT(left.joint_mm, 0.1);
  EXPECT_LT(left.limb_deg, 0.05);
  const Distance paper = DistanceOf(PaperBody(MeasureLimbLengths(clip.motion.poses)), clip.motion.poses);
  EXPECT_GT(paper.joint_mm, 3) << "the control: 29 degrees of freedom, and one shape for all";
}

INSTANTIATE_TEST_SUITE_P(Clips, NearestPoses,
                         ::testing::Values("builtin:boxing", "builtin:stretch", "builtin:jump",
                                           "/usr/share/assimp/models/BVH/01_01.bvh",
                                           "/usr/share/assimp/models/BVH/01_03.bvh",
                                           "/usr/share/assimp/models/BVH/Boxing_Toes.bvh"));

}  // namespace
}  // namespace etude
