#include "sim/annotator/evidence.h"

#include <gtest/gtest.h>

#include "sim/annotator/regions.h"
#include "tests/sim/annotator/annotated_body.h"

namespace etude {
namespace {

using enum Role;

PictureEvidence See(const BodyPose& pose, const Camera& camera) {
  return SeePicture(Shown(LabelsOf(BodyCapsules(pose), camera)).picture());
}

/// How far the evidence may lie from the true joint centre, pixels: limbs' ends are exact but for rasters and
/// perspective, joints inside the trunk are guessed from outside.
double LargestBias(Role role) {
  if (role == kLeftHip || role == kRightHip || role == kLeftShoulder || role == kRightShoulder) return 7;
  if (role == kShoulderCentre || role == kHead) return 10;
  return 4;
}

TEST(SeePicture, FindsJointCentresOfABodyThatHidesNothing) {
  EvidenceOptions eye;
  eye.look.head_below_crown =
      0.46;  // the shape puts this body's crown 4.3 cm above its head joint, and the head's radius is 9.3
  const PictureEvidence seen = SeePicture(Shown(LabelsOf(BodyCapsules(StandingBody()), FrontCamera())).picture(), eye);
  const ProjectionMatrix matrix = MatrixOf(FrontCamera());
  int found = 0;
  for (Role role : AllRoles()) {
    if (!seen.joints[Index(role)]) continue;
    ++found;
    EXPECT_LT(glm::distance(*seen.joints[Index(role)], *Project(matrix, StandingBody()[role])), LargestBias(role))
        << RoleName(role);
  }
  EXPECT_EQ(found, 18) << "all but hip centre and spine";
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    const StrokeMark& mark = StrokeMarks()[i];
    ASSERT_TRUE(seen.limbs[i]) << RoleName(mark.to);
    const glm::dvec2 limb = *Project(matrix, StandingBody()[mark.to]) - *Project(matrix, StandingBody()[mark.from]);
    EXPECT_GT(glm::dot(limb, seen.limbs[i]->line.b - seen.limbs[i]->line.a), 0) << RoleName(mark.to);
    EXPECT_EQ(seen.limbs[i]->line.a, *seen.joints[Index(mark.from)]) << "both limbs of a joint end in the same place";
    EXPECT_EQ(seen.limbs[i]->line.b, *seen.joints[Index(mark.to)]);
  }
}

// Two limbs with a straight joint, seen from aside: a ball of radius R shows beside a thinner limb of radius r as far
// as √(R² − r²) beyond the joint, and beside one at a right angle as far as R.
TEST(SeePicture, KnowsThatTheThickerLimbEndsRoundAboutTheJoint) {
  const Camera camera = LookAt({}, {0, 1, 3.8}, {0, 1, 0});
  const glm::dvec3 knee(0, 1, 0);
  for (const glm::dvec3 ankle : {glm::dvec3(0, 0.6, 0), glm::dvec3(0.15, 0.62, 0), glm::dvec3(0.4, 1, 0)}) {
    const std::vector<Capsule> body = {{Part::kTrunk, {0, 1.6, 0}, {0, 1.45, 0}, 0.12},
                                       {Part::kLeftThigh, {0, 1.42, 0}, knee, 0.07},
                                       {Part::kLeftShank, knee, ankle, 0.05},
                                       {Part::kLeftFoot, ankle, ankle + glm::dvec3(0.15, -0.05, 0), 0.028}};
    const PictureEvidence seen = SeePicture(Shown(LabelsOf(body, camera)).picture());
    ASSERT_TRUE(seen.joints[Index(kLeftKnee)]);
    EXPECT_LT(glm::distance(*seen.joints[Index(kLeftKnee)], *Project(MatrixOf(camera), knee)), 1.2) << ankle.x;
  }
}

TEST(SeePicture, DoesNotSeeALimbBehindTheBody) {
  BodyPose pose = StandingBody();
  for (const auto& [role, x] : {std::pair(kRightElbow, -0.16), {kRightWrist, -0.12}, {kRightHand, -0.1}}) {
    pose[role] = {x, pose[role].y - 0.25, -0.02};
  }
  pose[kRightElbow] = {-0.16, 1.2, 0};
  pose[kRightWrist] = {-0.1, 1.15, 0.02};
  pose[kRightHand] = {-0.05, 1.12, 0.02};
  const PictureEvidence seen = See(pose, SideCamera());
  for (Role hidden : {kRightElbow, kRightWrist, kRightHand}) {
    EXPECT_FALSE(seen.limbs[StrokeTo(hidden)]) << RoleName(hidden);
    EXPECT_FALSE(seen.joints[Index(hidden)]) << RoleName(hidden);
  }
  for (Role shown : {kLeftElbow, kLeftWrist, kLeftHand}) EXPECT_TRUE(seen.limbs[StrokeTo(shown)]) << RoleName(shown);
}

TEST(SeePicture, EndsALimbWhereAnotherOneCutsItOff) {
  // A bystander's arm before the left shank hides its last third, the ankle and the foot.
  Shown shown(LabelsOf(BodyCapsules(StandingBody()), FrontCamera()));
  const ProjectionMatrix matrix = MatrixOf(FrontCamera());
  const glm::dvec2 knee = *Project(matrix, StandingBody()[kLeftKnee]),
                   ankle = *Project(matrix, StandingBody()[kLeftAnkle]);
  const double cut = std::floor(glm::mix(knee.y, ankle.y, 0.67));
  for (int y = static_cast<int>(cut); y < shown.labels.height; ++y) {
    for (int x = 0; x < shown.labels.width; ++x) shown.labels.At(x, y) = 16;
  }
  const PictureEvidence seen = SeePicture(shown.picture());
  const auto& shank = seen.limbs[StrokeTo(kLeftAnkle)];
  ASSERT_TRUE(shank);
  EXPECT_NEAR(shank->line.b.y, cut, 1.5);
  EXPECT_LT(LineDistance(shank->line.b, {knee, ankle}), 1.5) << "too short, but along the limb";
  EXPECT_FALSE(seen.joints[Index(kLeftAnkle)]);
  EXPECT_FALSE(seen.limbs[StrokeTo(kLeftFoot)]);
  EXPECT_LT(shank->seen_share, 0.75);
}

// The control: a truth that disagrees with the picture changes nothing, because there is no way for it to come in.
TEST(SeePicture, FollowsThePictureOfAnotherBody) {
  BodyPose other = StandingBody();
  for (glm::dvec3& joint : other.joints) joint += glm::dvec3(0.3, 0.05, 0);
  other[kLeftWrist] = other[kLeftElbow] + glm::dvec3(0.2, -0.1, 0);
  other[kLeftHand] = other[kLeftWrist] + glm::dvec3(0.15, -0.1, 0);
  Camera camera = FrontCamera();
  camera.intrinsics = {};
  const PictureEvidence seen = See(other, camera);
  const ProjectionMatrix matrix = MatrixOf(camera);
  for (Role role : {kLeftWrist, kLeftHand, kRightKnee, kRightFoot}) {
    EXPECT_LT(glm::distance(*seen.joints[Index(role)], *Project(matrix, other[role])), 4) << RoleName(role);
    EXPECT_GT(glm::distance(*seen.joints[Index(role)], *Project(matrix, StandingBody()[role])), 20) << RoleName(role);
  }
}

TEST(SeePicture, LosesWhatTheSegmenterLost) {
  Shown shown(LabelsOf(BodyCapsules(StandingBody()), FrontCamera()));
  const double middle = Project(MatrixOf(FrontCamera()), StandingBody()[kRightShoulder])->x;
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 300; ++x) shown.person.At(x, y) = x > middle;
  }
  const PictureEvidence seen = SeePicture(shown.picture());
  for (Role lost : {kRightWrist, kRightHand}) {
    EXPECT_FALSE(seen.limbs[StrokeTo(lost)]) << RoleName(lost);
    EXPECT_FALSE(seen.joints[Index(lost)]) << RoleName(lost);
  }
  EXPECT_TRUE(seen.limbs[StrokeTo(kLeftWrist)]);
  EXPECT_TRUE(seen.joints[Index(kLeftHand)]);
}

TEST(SeePicture, MarksNoTipAtThePicturesEdge) {
  // The camera has turned away until the left hand leaves the picture.
  const Camera camera = LookAt({}, {0, 1.2, 2.2}, {-0.42, 1.1, 0});
  const glm::dvec2 hand = *Project(MatrixOf(camera), StandingBody()[kLeftHand]);
  const glm::dvec2 wrist = *Project(MatrixOf(camera), StandingBody()[kLeftWrist]);
  ASSERT_TRUE(hand.x > 640 && wrist.x < 640) << hand.x << " " << wrist.x;
  EXPECT_FALSE(See(StandingBody(), camera).joints[Index(kLeftHand)]);
}

TEST(SeePicture, TakesPicturesThatShowHardlyAnything) {
  const auto expect_nothing = [](const Shown& shown) {
    const PictureEvidence seen = SeePicture(shown.picture());
    for (const auto& limb : seen.limbs) EXPECT_FALSE(limb);
    for (const auto& joint : seen.joints) EXPECT_FALSE(joint);
  };
  expect_nothing(Shown(LabelImage(1, 1)));
  expect_nothing(Shown(LabelImage(640, 480)));
  expect_nothing(Shown(LabelImage(1, 1, static_cast<std::uint32_t>(Part::kHead))));
  for (int pixels = 1; pixels <= 3; ++pixels) {
    LabelImage specks(40, 40);
    for (std::uint32_t part = kFirstBodyPart; part < kPartCount; ++part) {
      for (int i = 0; i < pixels; ++i) specks.At(2 * static_cast<int>(part) + i % 2, 10 + i / 2) = part;
    }
    expect_nothing(Shown(specks));
  }
  Shown unseen(LabelsOf(BodyCapsules(StandingBody()), FrontCamera()));
  unseen.person = Mask(300, 400);
  expect_nothing(unseen);
  // A whole picture of one limb, with nothing to tell which end is which.
  expect_nothing(Shown(LabelImage(60, 20, static_cast<std::uint32_t>(Part::kLeftShank))));
}

}  // namespace
}  // namespace etude
