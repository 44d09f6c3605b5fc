#pragma once

#include <gtest/gtest.h>

#include "engine/motion/body.h"

namespace etude {

inline void ExpectSamePose(const BodyPose& a, const BodyPose& b, double tolerance) {
  for (Role role : AllRoles()) EXPECT_NEAR(glm::distance(a[role], b[role]), 0, tolerance) << RoleName(role);
}

inline void ExpectSameLimbs(const BodyMotion& motion, const BodyPose& expected) {
  for (const BodyPose& pose : motion.poses) {
    for (const Bone& bone : AllBones()) {
      ASSERT_NEAR(BoneLength(pose, bone), BoneLength(expected, bone), 1e-12) << RoleName(bone.child);
    }
  }
}

}  // namespace etude
