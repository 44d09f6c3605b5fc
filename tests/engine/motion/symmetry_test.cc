// Which joints bear a body does not depend on its position, its heading, or an exchange of left and right.
#include <gtest/gtest.h>

#include <vector>

#include "engine/motion/edit.h"
#include "engine/motion/statistics.h"
#include "engine/motion/support.h"
#include "sim/choreography/move.h"
#include "tests/support/random_clip.h"

namespace etude {
namespace {

BodyMotion NoisyMove(const std::string& name, double noise) {
  testing::Dice dice(name.size());
  BodyMotion motion = LoadBuiltinMove(name).value().motion;
  for (BodyPose& pose : motion.poses) {
    for (glm::dvec3& joint : pose.joints) joint += noise * dice.Vector();
  }
  return motion;
}

/// Returns moves with and without noise; one lying, one gliding, one walking away.
std::vector<BodyMotion> SomeMotions() {
  std::vector<BodyMotion> motions;
  for (const char* name : {"jump", "side_kick", "aerobic", "sway", "boxing"}) {
    for (const double noise : {0.0, 0.004}) motions.push_back(NoisyMove(name, noise));
  }
  BodyMotion lying = motions[1], gliding = motions[7], walking = motions[5];
  for (std::size_t f = 0; f < lying.poses.size(); ++f) {
    for (glm::dvec3& joint : lying.poses[f].joints) joint = {joint.x, joint.z, -joint.y};
  }
  for (std::size_t f = 0; f < gliding.poses.size(); ++f) {
    for (glm::dvec3& joint : gliding.poses[f].joints) joint.x += 0.05 * static_cast<double>(f);
  }
  for (std::size_t f = 0; f < walking.poses.size(); ++f) {
    for (glm::dvec3& joint : walking.poses[f].joints) joint += glm::dvec3(0.008, 0.001, -0.01) * static_cast<double>(f);
  }
  motions.insert(motions.end(), {lying, gliding, walking});
  return motions;
}

JointSet MirrorImage(const JointSet& joints) {
  JointSet image;
  for (const Role role : AllRoles()) image[Index(Mirrored(role))] = joints[Index(role)];
  return image;
}

/// Returns the motion turned by 90° about the vertical, elsewhere and half a metre higher.
BodyMotion Elsewhere(BodyMotion motion) {
  for (BodyPose& pose : motion.poses) {
    for (glm::dvec3& joint : pose.joints) joint = {joint.z + 2, joint.y + 0.5, -joint.x - 1};
  }
  return motion;
}

TEST(FindBearing, OfAMirrorImageIsTheMirrorImageAndOfABodyElsewhereTheSame) {
  for (const BodyMotion& motion : SomeMotions()) {
    const BodyMotion image = Mirror(motion), elsewhere = Elsewhere(motion);
    for (const SupportRules& rules : {SupportRules{}, kFootRules, SupportRules{.lowest = 0.3, .rest_speed = 1.2}}) {
      const auto bearing = FindBearing(motion.poses, motion.rate_hz, rules);
      const auto of_image = FindBearing(image.poses, motion.rate_hz, rules);
      const auto of_elsewhere = FindBearing(elsewhere.poses, motion.rate_hz, rules);
      for (std::size_t f = 0; f < bearing.size(); ++f) {
        EXPECT_EQ(of_image[f].rests, MirrorImage(bearing[f].rests)) << f;
        EXPECT_EQ(of_image[f].bears, MirrorImage(bearing[f].bears)) << f;
        EXPECT_EQ(of_elsewhere[f].rests, bearing[f].rests) << f;
        EXPECT_EQ(of_elsewhere[f].bears, bearing[f].bears) << f;
      }
    }
    const FootContacts contacts = FindFootContacts(motion.poses, motion.rate_hz);
    const FootContacts of_image = FindFootContacts(image.poses, motion.rate_hz);
    EXPECT_EQ(of_image[0], contacts[1]);
    EXPECT_EQ(of_image[1], contacts[0]);
    EXPECT_EQ(FindFootContacts(elsewhere.poses, motion.rate_hz), contacts);
  }
}

TEST(ComputeStatistics, OfAMirrorImageAndOfABodyElsewhereAreTheSame) {
  for (const BodyMotion& motion : SomeMotions()) {
    const MotionStatistics own = ComputeStatistics(motion);
    for (const auto& [other, lift] : {std::pair{Mirror(motion), 0.0}, {Elsewhere(motion), 0.5}}) {
      const MotionStatistics found = ComputeStatistics(other);
      EXPECT_NEAR(found.stature_m, own.stature_m, 1e-9);
      EXPECT_NEAR(found.travelled_m, own.travelled_m, 1e-9);
      EXPECT_NEAR(found.speed_median_m_s, own.speed_median_m_s, 1e-9);
      EXPECT_NEAR(found.speed_p95_m_s, own.speed_p95_m_s, 1e-9);
      EXPECT_NEAR(found.speed_peak_m_s, own.speed_peak_m_s, 1e-9);
      EXPECT_NEAR(found.lowest_foot_m, own.lowest_foot_m + lift, 1e-9);
      for (const std::size_t foot : {0, 1}) {  // the mirror image exchanges left and right
        const double share = own.foot_slide.stance_share[lift > 0 ? foot : 1 - foot];
        EXPECT_NEAR(found.foot_slide.stance_share[foot], share, 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace etude
