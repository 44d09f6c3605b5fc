#include "bench/tasks/capture/marking.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/choreography/canonical_body.h"
#include "sim/render/renderer.h"
#include "sim/stage/wardrobe.h"
#include "tests/sim/annotator/annotated_body.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;

CaptureWorld StandingWorld() {
  CaptureWorld world{.truth = {StandingBody()}, .cameras = {FrontCamera()}};
  return world;
}

class MarkingTest : public ::testing::Test {
 protected:
  AnnotatedPicture picture() const { return shown_.picture(); }
  Marking MarkingBy(int annotators, double error_px, int trial = 0) const {
    StudioOptions options{.annotators = annotators};
    options.annotation_error_px = error_px;
    return Marking(options, world_, {.suite_seed = 3, .scenario = "marking", .trial = trial});
  }

  const CaptureWorld world_ = StandingWorld();
  const Shown shown_{LabelsOf(BodyCapsules(StandingBody()), FrontCamera())};
};

TEST(MeanMarks, IsTheMeanOfBothOrTheOneThereIs) {
  Marks a, b;
  a.strokes[0] = PixelSegment{{0, 0}, {10, 0}};
  b.strokes[0] = PixelSegment{{2, 4}, {14, 8}};
  a.strokes[1] = PixelSegment{{1, 1}, {2, 2}};
  b.effectors[3] = glm::dvec2(5, 6);
  a.effectors[4] = glm::dvec2(1, 1);
  b.effectors[4] = glm::dvec2(3, 5);
  const Marks mean = MeanMarks(a, b);
  EXPECT_EQ(mean.strokes[0]->a, glm::dvec2(1, 2));
  EXPECT_EQ(mean.strokes[0]->b, glm::dvec2(12, 4));
  EXPECT_EQ(mean.strokes[1]->b, glm::dvec2(2, 2));
  EXPECT_FALSE(mean.strokes[2]);
  EXPECT_EQ(mean.effectors[3], glm::dvec2(5, 6));
  EXPECT_EQ(mean.effectors[4], glm::dvec2(2, 3));
  EXPECT_FALSE(mean.effectors[0]);
}

TEST_F(MarkingTest, TwoPerfectAnnotatorsAgreeAndOneHasNobodyToAgreeWith) {
  Marking two = MarkingBy(2, 0), one = MarkingBy(1, 0);
  const Marks of_two = two.Mark(0, 0, picture()), of_one = one.Mark(0, 0, picture());
  EXPECT_EQ(AnnotatorDistancePx(two.joints()), 0);
  EXPECT_EQ(AnnotatorOverlap(two.limbs()), 1);
  EXPECT_FALSE(AnnotatorDistancePx(one.joints()));
  EXPECT_FALSE(AnnotatorOverlap(one.limbs()));
  for (std::size_t i = 0; i < kEffectorCount; ++i) EXPECT_EQ(of_two.effectors[i], of_one.effectors[i]) << i;
}

// The difference of two people's marks has twice the variance of one person's. The mean of a Rayleigh variable is
// √(π/2) of its deviation.
TEST_F(MarkingTest, TwoAnnotatorsDifferAsTwoIndependentHandsDo) {
  double px = 0;
  constexpr int kTrials = 40;
  for (int trial = 0; trial < kTrials; ++trial) {
    Marking two = MarkingBy(2, 1, trial);
    (void)two.Mark(0, 0, picture());
    px += *AnnotatorDistancePx(two.joints()) / kTrials;
  }
  EXPECT_NEAR(px, std::sqrt(2.0) * std::sqrt(kPi / 2), 0.35);
}

TEST_F(MarkingTest, TheFirstOfTwoMarksAsTheOnlyOneDoes) {
  Marking one = MarkingBy(1, 2), two = MarkingBy(2, 2);
  const Marks alone = one.Mark(0, 0, picture());
  (void)two.Mark(0, 0, picture());
  int compared = 0;
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    if (!alone.effectors[i]) continue;
    EXPECT_EQ(two.joints()[Index(EffectorMarks()[i].role)].first, alone.effectors[i]);
    ++compared;
  }
  EXPECT_GE(compared, 4);
}

TEST_F(MarkingTest, TrueJointsAreMarkedExactlyWhereThePictureShowsThem) {
  const Marking marking = MarkingBy(1, 5);
  const Marks marks = marking.MarkTrueJoints(0, picture(), FrontCamera(), StandingBody());
  int strokes = 0;
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (!marks.strokes[i]) continue;
    ++strokes;
    EXPECT_EQ(marks.strokes[i]->a, *Project(FrontCamera(), StandingBody()[StrokeMarks()[i].from]));
    EXPECT_EQ(marks.strokes[i]->b, *Project(FrontCamera(), StandingBody()[StrokeMarks()[i].to]));
  }
  EXPECT_GE(strokes, 11);
  const Mask nobody(picture().labels.width, picture().labels.height);
  const Marks unseen =
      marking.MarkTrueJoints(0, {picture().labels, picture().colours, nobody}, FrontCamera(), StandingBody());
  for (const auto& stroke : unseen.strokes) EXPECT_FALSE(stroke) << "nobody was cut out";
  for (const auto& disc : unseen.effectors) EXPECT_FALSE(disc);
}

TEST_F(MarkingTest, FramesThatNobodyIsAskedToMarkStayEmpty) {
  StudioOptions options{.mark_every = 3};
  Marking marking(options, world_, {.suite_seed = 3, .scenario = "marking", .trial = 0});
  for (std::size_t frame = 0; frame < 7; ++frame) {
    const Marks marks = marking.Mark(0, frame, picture());
    EXPECT_EQ(marks.effectors[0].has_value(), frame % 3 == 0) << frame;
  }
}

// The proportions for FigureKind::kDressed were measured on clothed people who hold their arms out, seen from the
// front. With the proportions for FigureKind::kCapsules, hips and shoulders would be far from the true joints.
TEST(SeePicture, KnowsWherePeopleInClothesHaveTheirJoints) {
  ASSERT_OK(renderer, SharedRenderer());
  const Camera camera = LookAt({}, {0, 1.2, 3.6}, {0, 1, 0});
  BodyPose body = StandingBody();
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    if (MakeOutfit(seed, "performer", Wardrobe::kStudio, 1).is_skirt) continue;  // a skirt hides hips and knees
    const StagedRoom stage({.seed = seed, .scene = 0.5}, std::span(&body, 1), std::span(&camera, 1));
    const Figure figure = stage.PerformerAt(body, PerformerColours());
    const View view = (*renderer)->Render({}, {figure}, camera, Targets::kColourAndLabels);
    const Shown shown(view.labels);
    EvidenceOptions eye{.look = {.figure = FigureKind::kDressed, .head_below_crown = HeadBelowCrown(figure, body)}};
    const auto miss_mm = [&](Role role) {
      const auto joint = SeePicture(shown.picture(), eye).joints[Index(role)];
      const double distance = -(camera.R_CW * (camera.p_WC - body[role])).z;
      return joint ? glm::distance(*joint, *Project(camera, body[role])) * distance / camera.intrinsics.fx * 1000 : 1e9;
    };
    for (const Role role : {kLeftHip, kRightHip}) EXPECT_LT(miss_mm(role), 50) << RoleName(role) << ", seed " << seed;
    for (const Role role :
         {kLeftShoulder, kRightShoulder, kLeftElbow, kRightElbow, kLeftAnkle, kRightAnkle, kShoulderCentre, kHead}) {
      EXPECT_LT(miss_mm(role), 35) << RoleName(role) << ", seed " << seed;
    }
    for (const Role role :
         {kLeftKnee, kRightKnee, kLeftWrist, kRightWrist, kLeftHand, kRightHand, kLeftFoot, kRightFoot}) {
      EXPECT_LT(miss_mm(role), 15) << RoleName(role) << ", seed " << seed;
    }
    eye.look.figure = FigureKind::kCapsules;
    EXPECT_GT(miss_mm(kLeftShoulder), 50) << "the control";
  }
}

TEST(HeadBelowCrown, FollowsFromTheShapeWhateverThePose) {
  BodyPose pose = StandingBody();
  const double standing = HeadBelowCrown({BodyCapsules(pose)}, pose);
  // A trunk of 50 cm has a skull of radius 9.25 cm, whose centre is 3 cm beyond 17 cm above the neck's base; the head
  // joint lies 25.1 cm above it.
  EXPECT_NEAR(standing, (0.17 + 0.03 + 0.0925 - std::hypot(0.25, 0.02)) / 0.0925, 1e-9);
  const glm::dvec3 neck = pose[Role::kShoulderCentre];
  const glm::dvec3 head = pose[Role::kHead] - neck;
  pose[Role::kHead] = neck + glm::dvec3(head.y, -head.x, head.z);  // the head is tilted sideways by 90°
  EXPECT_NEAR(HeadBelowCrown({BodyCapsules(pose)}, pose), standing, 1e-9);
}

}  // namespace
}  // namespace etude
