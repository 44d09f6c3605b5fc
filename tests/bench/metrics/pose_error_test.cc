#include "bench/metrics/pose_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

BodyPose SomePose() {
  BodyPose pose;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    const double t = static_cast<double>(i);
    pose.joints[i] = {std::sin(1.3 * t), 1 + std::cos(2.1 * t), std::sin(0.7 * t + 1)};
  }
  return pose;
}

BodyPose Moved(BodyPose pose, auto move) {
  for (glm::dvec3& joint : pose.joints) joint = move(joint);
  return pose;
}

glm::dvec3 Turned(const glm::dvec3& p) {  // by 90° about Y
  return {p.z, p.y, -p.x};
}

TEST(PoseErrors, AreZeroForTheTruthItself) {
  const std::vector<BodyPose> truth = {SomePose(), SomePose()};
  const PoseErrors errors = ComparePoses(truth, truth);
  EXPECT_EQ(errors.mpjpe_mm, 0);
  EXPECT_NEAR(errors.pa_mpjpe_mm, 0, 1e-9);
  EXPECT_EQ(errors.pck_50mm, 1);
  EXPECT_EQ(errors.auc_200mm, 1);
  EXPECT_EQ(errors.bone_length_error_cm, 0);
}

TEST(PoseErrors, HaveTheValuesOfAVectorCountedByHand) {
  // Frame 1: half of the joints off by 30 mm, the others by 100 mm; frame 2 perfect.
  const BodyPose truth = SomePose();
  BodyPose found = truth;
  for (std::size_t i = 0; i < kRoleCount; ++i) found.joints[i].y += i % 2 == 0 ? 0.03 : 0.1;
  const PoseErrors errors = ComparePoses(std::vector{found, truth}, std::vector{truth, truth});
  EXPECT_NEAR(errors.mpjpe_mm, 65.0 / 2, 1e-9);
  EXPECT_NEAR(errors.frame_mpjpe_mm[0], 65, 1e-9);
  EXPECT_EQ(errors.frame_mpjpe_mm[1], 0);
  EXPECT_NEAR(errors.pck_50mm, (0.5 + 1) / 2, 1e-12);
  EXPECT_NEAR(errors.auc_200mm, ((0.85 + 0.5) / 2 + 1) / 2, 1e-12);
}

TEST(PoseErrors, CountAJointBeyondTheEndOfTheCurveAsNothing) {
  const BodyPose truth = SomePose();
  const BodyPose far = Moved(truth, [](glm::dvec3 p) { return p + glm::dvec3(0.5, 0, 0); });
  const PoseErrors errors = ComparePoses(std::vector{far}, std::vector{truth});
  EXPECT_EQ(errors.auc_200mm, 0);
  EXPECT_EQ(errors.pck_50mm, 0);
}

TEST(PoseErrors, MeasureLimbLengthsWhateverTheirDirection) {
  const BodyPose truth = SomePose();
  const PoseErrors turned = ComparePoses(std::vector{Moved(truth, Turned)}, std::vector{truth});
  EXPECT_NEAR(turned.bone_length_error_cm, 0, 1e-9);
  const BodyPose larger = Moved(truth, [](glm::dvec3 p) { return 1.1 * p; });
  double mean_cm = 0;
  for (const Bone& bone : AllBones()) mean_cm += 100 * BoneLength(truth, bone) / 19;
  EXPECT_NEAR(ComparePoses(std::vector{larger}, std::vector{truth}).bone_length_error_cm, 0.1 * mean_cm, 1e-9);
}

TEST(AlignSimilarity, UndoesATurnAShiftAndAScale) {
  const BodyPose truth = SomePose();
  const BodyPose found = Moved(truth, [](glm::dvec3 p) { return 1.7 * Turned(p) + glm::dvec3(3, -2, 5); });
  EXPECT_GT(FrameMpjpeMm(found, truth), 1000);
  EXPECT_NEAR(FramePaMpjpeMm(found, truth), 0, 1e-9);
  EXPECT_NEAR(AlignSimilarity(found.joints, truth.joints).scale, 1 / 1.7, 1e-12);
}

TEST(AlignSimilarity, DoesNotForgiveAMirroredBody) {
  const BodyPose truth = SomePose();
  const BodyPose mirrored = Moved(truth, [](glm::dvec3 p) { return glm::dvec3(-p.x, p.y, p.z); });
  const Similarity similarity = AlignSimilarity(mirrored.joints, truth.joints);
  EXPECT_NEAR(glm::determinant(similarity.rotation), 1, 1e-12);
  EXPECT_GT(FramePaMpjpeMm(mirrored, truth), 100);
}

TEST(AlignSimilarity, SurvivesPointsInOnePlaceOrOnALine) {
  const BodyPose truth = SomePose();
  BodyPose point;  // all joints at the origin
  EXPECT_TRUE(std::isfinite(FramePaMpjpeMm(point, truth)));
  const BodyPose line = Moved(truth, [](glm::dvec3 p) { return glm::dvec3(p.x, 0, 0); });
  EXPECT_TRUE(std::isfinite(FramePaMpjpeMm(line, truth)));
  EXPECT_TRUE(std::isfinite(FramePaMpjpeMm(truth, point)));
}

}  // namespace
}  // namespace etude
