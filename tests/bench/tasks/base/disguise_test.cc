#include "bench/tasks/base/disguise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/clips/clip_library.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;

WorldKey SecretWorld(std::uint64_t number) { return {Seed::Secret({number, 2, 3, 4}), "disguise", 0}; }

TEST(SmoothRandomFunction, HaveMeanZeroAndDeviationOneAndNoJumps) {
  double sum = 0, squares = 0, fastest = 0;
  int count = 0;
  for (std::uint64_t world = 0; world < 400; ++world) {
    SmoothRandomFunction dice(SecretWorld(world), "test");
    for (int k = 0; k < 150; ++k, ++count) {
      const double value = dice.At(k / 30.0);
      sum += value;
      squares += value * value;
      fastest = std::max(fastest, std::abs(dice.At(k / 30.0 + 1e-6) - value) / 1e-6);
    }
  }
  EXPECT_NEAR(sum / count, 0, 0.1);
  EXPECT_NEAR(std::sqrt(squares / count), 1, 0.05);
  EXPECT_LT(fastest, 10) << "a second";
  EXPECT_GT(fastest, 2) << "they wander";
}

TEST(Disguise, KeepsLimbsAndTheFloorAndOverstretchesNothing) {
  ASSERT_OK(clips, LoadClips({"builtin:boxing", "builtin:stretch"}, {}));
  double most_turned_deg = 0;
  for (const LibraryClip& clip : clips->clips) {
    const std::vector<BodyPose>& old = clip.motion.poses;
    const Disguise disguise(SecretWorld(7));
    std::vector<BodyPose> worn = old;
    disguise.ApplyTo(worn, 30);
    for (std::size_t k = 0; k < old.size(); ++k) {
      double lowest_old = 9, lowest_new = 9;
      for (const Role role : AllRoles()) {
        lowest_old = std::min(lowest_old, old[k][role].y);
        lowest_new = std::min(lowest_new, worn[k][role].y);
      }
      EXPECT_NEAR(lowest_new, disguise.scale() * lowest_old, 1e-9);
      for (const Bone& bone : AllBones()) {
        EXPECT_NEAR(BoneLength(worn[k], bone), disguise.scale() * BoneLength(old[k], bone), 1e-9);
      }
      for (const auto& [one, other] : {std::pair{kLeftHip, kRightHip}, std::pair{kLeftShoulder, kRightShoulder},
                                       std::pair{kSpine, kLeftHip}, std::pair{kShoulderCentre, kLeftShoulder}}) {
        EXPECT_NEAR(glm::distance(worn[k][one], worn[k][other]),
                    disguise.scale() * glm::distance(old[k][one], old[k][other]), 1e-9);
      }
      const auto bend = [&](const BodyPose& pose) {
        return glm::cross(pose[kLeftElbow] - pose[kLeftShoulder], pose[kLeftWrist] - pose[kLeftElbow]);
      };
      const double turned = glm::length(bend(worn[k])) - glm::length(bend(old[k]));
      most_turned_deg = std::max(most_turned_deg, std::abs(turned));
    }
  }
  EXPECT_GT(most_turned_deg, 1e-3) << "elbows are not as they were";
}

TEST(Disguise, PlaysNoFrameOfTheClipItselfAndEndsWithIt) {
  const Disguise disguise(SecretWorld(1));
  double before = -1;
  for (std::size_t k = 0; k < 40; ++k) {
    const double frame = disguise.FrameOf(0, 1, k, 30);
    EXPECT_GE(frame, before);
    EXPECT_LE(frame, 30);
    before = frame;
  }
  EXPECT_GT(std::abs(disguise.FrameOf(3, 1, 0, 30) - 3), 1e-6);
}

}  // namespace
}  // namespace etude
