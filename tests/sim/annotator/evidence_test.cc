#include "sim/annotator/evidence.h"

#include <gtest/gtest.h>

#include "engine/base/angles.h"
#include "engine/vision/limb_regions.h"
#include "tests/sim/annotator/annotated_body.h"

namespace etude {
namespace {

using enum Role;

PictureEvidence See(const BodyPose& pose, const Camera& camera) {
  return SeePicture(Shown(LabelsOf(BodyCapsules(pose), camera)).picture());
}

/// Returns the largest allowed distance (pixels) of the evidence from the true joint centre. At the ends of limbs,
/// only pixel rounding and perspective cause errors; joints inside the trunk are extrapolated from the limbs' visible
/// parts.
double LargestBias(Role role) {
  if (role == kLeftHip || role == kRightHip || role == kLeftShoulder || role == kRightShoulder) return 7;
  if (role == kShoulderCentre || role == kHead) return 10;
  return 4;
}

TEST(SeePicture, FindsJointCentresOfABodyThatHidesNothing) {
  EvidenceOptions eye;
  eye.look.head_below_crown =
      0.46;  // this body's crown is 4.3 cm above its head joint, and the head's radius is 9.3 cm
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

// Two limbs seen from the side: at a straight joint, a ball of radius R shows beside a thinner limb of radius r up to
// √(R² − r²) beyond the joint; at a right angle, up to R.
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
  // A bystander's arm in front of the left shank hides its last third, the ankle and the foot.
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

// The control: a truth that disagrees with the picture changes nothing, because only the picture is an input.
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
  // The camera is turned so far that the left hand leaves the picture.
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
  // The picture shows only one limb, without a hint which end is which.
  expect_nothing(Shown(LabelImage(60, 20, static_cast<std::uint32_t>(Part::kLeftShank))));
}

constexpr auto kThigh = static_cast<std::uint32_t>(Part::kLeftThigh);
constexpr auto kShank = static_cast<std::uint32_t>(Part::kLeftShank);
constexpr std::uint32_t kChair = 16;

// Returns a thigh of 10 × 4 pixels above a shank of 10 × 6, beside a bystander's leg.
LabelImage Leg() {
  LabelImage labels(30, 20);
  for (int y = 2; y < 12; ++y) {
    for (int x = 5; x < 15; ++x) labels.At(x, y) = y < 6 ? kThigh : kShank;
    for (int x = 18; x < 20; ++x) labels.At(x, y) = kChair;
  }
  return labels;
}

TEST(FindRegions, CountsEachPartsPixelsAndTheirMiddle) {
  const Shown shown(Leg());
  const Regions regions = FindRegions(shown.labels, shown.colours, shown.person, 0);
  EXPECT_EQ(regions[Part::kLeftThigh].pixels, 40);
  EXPECT_EQ(regions[Part::kLeftShank].pixels, 60);
  EXPECT_EQ(regions[Part::kLeftThigh].middle, glm::dvec2(10, 4));
  EXPECT_EQ(regions[Part::kLeftShank].middle, glm::dvec2(10, 9));
  int all = 0;
  for (const Region& region : regions.parts) all += region.pixels;
  EXPECT_EQ(all, 100) << "furniture and other people are no part of the performer";
}

TEST(FindRegions, FindsTheCommonBorderOfNeighboursInTheBody) {
  const Shown shown(Leg());
  const Regions regions = FindRegions(shown.labels, shown.colours, shown.person, 0);
  const auto& knee = regions.borders[StrokeTo(Role::kLeftAnkle)];
  ASSERT_EQ(knee.size(), 10u);
  for (std::size_t i = 0; i < knee.size(); ++i) EXPECT_EQ(knee[i], glm::dvec2(5.5 + static_cast<double>(i), 6));
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (i == StrokeTo(Role::kLeftAnkle)) continue;
    EXPECT_TRUE(regions.borders[i].empty());
  }
}

TEST(FindRegions, SeesNothingThatTheSegmenterLostButForTheMargin) {
  Shown shown(Leg());
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 30; ++x) shown.person.At(x, y) = x < 8;
  }
  EXPECT_EQ(FindRegions(shown.labels, shown.colours, shown.person, 0)[Part::kLeftShank].pixels, 3 * 6);
  EXPECT_EQ(FindRegions(shown.labels, shown.colours, shown.person, 2)[Part::kLeftShank].pixels, 5 * 6);
  shown.person = Mask(30, 20);
  for (const Region& region : FindRegions(shown.labels, shown.colours, shown.person, 3).parts) {
    EXPECT_EQ(region.pixels, 0);
  }
}

TEST(FindRegions, MeasuresContrastAcrossTheOutlineAndNotTowardsTheNextLimb) {
  Shown shown(Leg());
  for (auto& pixel : shown.colours.pixels) pixel = {50, 60, 70};
  for (int y = 2; y < 12; ++y) {
    for (int x = 5; x < 15; ++x) shown.colours.At(x, y) = {53, 64, 70};
  }
  const Regions regions = FindRegions(shown.labels, shown.colours, shown.person, 0);
  EXPECT_DOUBLE_EQ(regions[Part::kLeftThigh].contrast, 5);  // √(3² + 4²)
  EXPECT_DOUBLE_EQ(regions[Part::kLeftShank].contrast, 5);
}

MiddleLine LineOf(const std::vector<Capsule>& body, const Camera& camera, Part part) {
  const Shown shown(LabelsOf(body, camera));
  const Regions regions = FindRegions(shown.labels, shown.colours, shown.person, 0);
  EXPECT_GT(regions[part].pixels, 0);
  return FindMiddleLine(regions[part]);
}

// A cylinder's outline lies in two tangent planes through the camera, at equal angles δ to the plane through its axis.
// In the picture, the outline is at tan(θ ± δ) and the axis at tan θ, in focal lengths. So the middle of the outline is
// off the axis by only about δ² tan θ / cos² θ, here less than a pixel.
TEST(FindMiddleLine, OfACapsuleSeenWholeIsItsAxisToAPixelWithBothEnds) {
  const Camera camera = LookAt({}, {0.3, 1.2, 3.5}, {0, 1, 0});
  const ProjectionMatrix matrix = MatrixOf(camera);
  int checked = 0;
  for (int turn = 0; turn < 18; ++turn) {
    for (const double towards_camera : {0.0, 0.15, -0.15}) {
      const double angle = Radians(10.0 * turn + 3);
      const glm::dvec3 half(0.22 * std::cos(angle), 0.22 * std::sin(angle), towards_camera);
      const Capsule limb{Part::kLeftThigh, glm::dvec3(0.1, 1, 0) - half, glm::dvec3(0.1, 1, 0) + half, 0.06};
      const MiddleLine line = LineOf({limb}, camera, Part::kLeftThigh);
      glm::dvec2 a = *Project(matrix, limb.a), b = *Project(matrix, limb.b);
      if (glm::dot(b - a, line.along) < 0) std::swap(a, b);
      const PixelSegment found{line.At(line.low + line.half_width), line.At(line.high - line.half_width)};
      EXPECT_LT(LineDistance(a, found), 1) << turn;
      EXPECT_LT(LineDistance(b, found), 1) << turn;
      // A ball nearer to the camera looks larger than the limb, a farther one smaller, which biases the ends.
      const double bias = towards_camera == 0 ? 1 : 1.6;
      EXPECT_LT(glm::distance(found.a, a), bias) << turn;
      EXPECT_LT(glm::distance(found.b, b), bias) << turn;
      ++checked;
    }
  }
  EXPECT_EQ(checked, 54);
}

TEST(FindMiddleLine, StaysInTheMiddleOfALimbWhoseEndIsCutOffAslant) {
  LabelImage labels(200, 100);
  for (int y = 40; y < 60; ++y) {
    for (int x = 20 + (y - 40); x < 150; ++x) labels.At(x, y) = static_cast<std::uint32_t>(Part::kLeftShank);
  }
  const Shown shown(labels);
  const Regions regions = FindRegions(shown.labels, shown.colours, shown.person, 0);
  const MiddleLine line = FindMiddleLine(regions[Part::kLeftShank]);
  EXPECT_NEAR(std::abs(line.along.x), 1, 1e-4);
  EXPECT_NEAR(line.At(0).y, 50, 0.3);
  EXPECT_NEAR(line.half_width, 10, 0.5);
  EXPECT_TRUE(line.IsLong());
}

TEST(FindMiddleLine, OfADiscHasNoDirectionOfItsOwn) {
  const Capsule ball{Part::kHead, {0, 1, 0}, {0, 1, 0}, 0.1};
  EXPECT_FALSE(LineOf({ball}, FrontCamera(), Part::kHead).IsLong());
}

TEST(FindMiddleLine, OfASinglePixelIsThatPixel) {
  LabelImage labels(5, 5);
  labels.At(3, 1) = static_cast<std::uint32_t>(Part::kHead);
  const Shown shown(labels);
  const MiddleLine line = FindMiddleLine(FindRegions(shown.labels, shown.colours, shown.person, 0)[Part::kHead]);
  EXPECT_EQ(line.origin, glm::dvec2(3.5, 1.5));
  EXPECT_EQ(line.half_width, 0.5);
  EXPECT_EQ(line.high - line.low, 1);
}

}  // namespace

}  // namespace etude
