#include <gtest/gtest.h>

#include "engine/base/angles.h"
#include "engine/retargeting/up_axis.h"
#include "tests/support/body_of_person.h"

namespace etude {
namespace {

BodyPose StandingPerson() {
  const Skeleton person = testing::PersonSkeleton();
  return testing::BodyAtRest(person, *FindJointMap(person, "person.bvh"));
}

BodyPose Turned(BodyPose pose, double radians, const glm::dvec3& axis, const glm::dvec3& shift = {}) {
  for (glm::dvec3& joint : pose.joints) joint = glm::angleAxis(radians, axis) * joint + shift;
  return pose;
}

BodyPose StandingAlongZ(const glm::dvec3& shift = {}) { return Turned(StandingPerson(), kPi / 2, {1, 0, 0}, shift); }

BodyPose Folded() { return Turned(StandingPerson(), kPi / 2, {0, 0, 1}); }

UpAxis FindUpAxis(const BodyPose& rest, std::span<const BodyPose> poses) {
  return FindUp(rest, poses, 30).axis.z > 0 ? UpAxis::kZ : UpAxis::kY;
}

TEST(UpAxis, IsWhatTheRestPoseStandsAlongUnlessTheBodyMovesOtherwise) {
  const std::vector<BodyPose> still_y = {StandingPerson(), StandingPerson()};
  const std::vector<BodyPose> still_z = {StandingAlongZ(), StandingAlongZ()};
  EXPECT_EQ(FindUpAxis(StandingPerson(), still_y), UpAxis::kY);
  EXPECT_EQ(FindUpAxis(StandingAlongZ(), still_z), UpAxis::kZ);
  EXPECT_EQ(FindUpAxis(StandingAlongZ(), still_y), UpAxis::kY);
  EXPECT_EQ(FindUpAxis(StandingPerson(), still_z), UpAxis::kY) << "lies";
  EXPECT_EQ(FindUpAxis(Folded(), still_z), UpAxis::kZ);
  EXPECT_EQ(FindUpAxis(Folded(), still_y), UpAxis::kY);
  EXPECT_EQ(FindUpAxis(Folded(), {&still_y[0], 1}), UpAxis::kY);
}

TEST(UpAxis, OfABodyThatTravelsStandingAlongZIsZ) {
  const std::vector<BodyPose> walk = {StandingAlongZ(), StandingAlongZ({0, -60, 0}), StandingAlongZ({0, -120, 0})};
  EXPECT_EQ(FindUpAxis(StandingPerson(), walk), UpAxis::kZ);
  // The control: a person lying along Z may creep along Z.
  const std::vector<BodyPose> creep = {StandingAlongZ(), StandingAlongZ({0, 0, 60}), StandingAlongZ({0, 0, 120})};
  EXPECT_EQ(FindUpAxis(StandingPerson(), creep), UpAxis::kY);
}

TEST(UpAxis, OfSomersaultsIsTheRestPoses) {
  std::vector<BodyPose> over;
  for (int i = 0; i < 24; ++i) over.push_back(Turned(StandingPerson(), i * kPi / 12, {1, 0, 0}));
  EXPECT_LT(glm::length(MeanBodyAxis(over)), 1e-12);
  EXPECT_EQ(FindUpAxis(StandingPerson(), over), UpAxis::kY);
  EXPECT_EQ(FindUpAxis(StandingAlongZ(), over), UpAxis::kZ);
  EXPECT_EQ(FindUpAxis(Folded(), over), UpAxis::kY) << "in doubt";
}

TEST(UpAxis, OfSeveralPosesIsTheirMean) {
  const std::vector<BodyPose> both = {StandingPerson(), StandingAlongZ()};
  const glm::dvec3 y = MeanBodyAxis({&both[0], 1}), z = MeanBodyAxis({&both[1], 1});
  EXPECT_LT(glm::length(MeanBodyAxis(both) - (y + z) / 2.0), 1e-12);
  EXPECT_NEAR(glm::length(y), 1, 1e-12) << "of one pose it is a direction";
}

TEST(UpAxis, OfAmassInACamerasFrameIsDoubted) {
  const auto doubt = [](const BodyPose& pose) { return FindUp(std::vector(3, pose), 30, AmassUp()).doubt; };
  EXPECT_EQ(doubt(StandingAlongZ()), "");
  EXPECT_EQ(doubt(StandingPerson()),
            "the body stands along Y, but Z is the convention of AMASS; --up sets another axis");
  EXPECT_EQ(doubt(Turned(StandingPerson(), kPi, {1, 0, 0})),
            "the body stands along −Y, but Z is the convention of AMASS; --up allows only Y or Z, so rotate the file "
            "first");
  EXPECT_EQ(doubt(Turned(StandingPerson(), kPi / 2, {0, 0, 1})), "") << "lies along X";
}

TEST(Upright, KeepsHandednessAndTurnsMinusYToPlusZ) {
  const glm::dvec3 x = Upright({1, 0, 0}, UpAxis::kZ), y = Upright({0, 1, 0}, UpAxis::kZ),
                   z = Upright({0, 0, 1}, UpAxis::kZ);
  EXPECT_EQ(z, glm::dvec3(0, 1, 0));
  EXPECT_EQ(y, glm::dvec3(0, 0, -1));
  EXPECT_EQ(glm::cross(x, y), z);
  EXPECT_EQ(Upright({1, 2, 3}, UpAxis::kY), glm::dvec3(1, 2, 3));
}

}  // namespace
}  // namespace etude
