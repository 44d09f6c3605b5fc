#include "sim/sensors/annotator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

// A standing person with the arms half raised, about 1.8 m tall.
BodyPose StandingBody() {
  using enum Role;
  BodyPose pose;
  pose[kHipCentre] = {0, 0.95, 0};
  pose[kSpine] = {0, 1.15, 0};
  pose[kShoulderCentre] = {0, 1.45, 0};
  pose[kHead] = {0, 1.7, 0.02};
  for (const double side : {1.0, -1.0}) {
    const bool left = side > 0;
    pose[left ? kLeftShoulder : kRightShoulder] = {side * 0.18, 1.43, 0};
    pose[left ? kLeftElbow : kRightElbow] = {side * 0.42, 1.3, 0.05};
    pose[left ? kLeftWrist : kRightWrist] = {side * 0.6, 1.48, 0.12};
    pose[left ? kLeftHand : kRightHand] = {side * 0.72, 1.6, 0.15};
    pose[left ? kLeftHip : kRightHip] = {side * 0.1, 0.92, 0};
    pose[left ? kLeftKnee : kRightKnee] = {side * 0.12, 0.5, 0.03};
    pose[left ? kLeftAnkle : kRightAnkle] = {side * 0.13, 0.08, 0};
    pose[left ? kLeftFoot : kRightFoot] = {side * 0.15, 0.03, 0.18};
  }
  return pose;
}

Camera FrontCamera() { return LookAt({}, {1.5, 1.4, 3.5}, {0, 0.95, 0}); }
const Mask kEverywhere(640, 480, 1);

ColourImage Draw(const Mask& person, double error_px, int trial) {
  RandomStream random({.suite_seed = 5, .scenario = "annotator", .trial = trial}, "annotator");
  AnnotatorOptions options;
  options.error_px = error_px;
  return Annotate(StandingBody(), BodyCapsules(StandingBody()), FrontCamera(), person, options, random);
}

double LineDistance(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 d = glm::normalize(b - a), r = p - a;
  return std::abs(d.x * r.y - d.y * r.x);
}

TEST(Annotator, MarksAreReadBackWithinAPixelWhenTheHandIsSteady) {
  const Marks marks = ReadMarks(Draw(kEverywhere, 0, 0));
  const ProjectionMatrix matrix = MatrixOf(FrontCamera());
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    const StrokeMark& mark = StrokeMarks()[i];
    ASSERT_TRUE(marks.strokes[i]) << RoleName(mark.from) << " to " << RoleName(mark.to);
    const glm::dvec2 from = *Project(matrix, StandingBody()[mark.from]), to = *Project(matrix, StandingBody()[mark.to]);
    EXPECT_LT(LineDistance(from, marks.strokes[i]->a, marks.strokes[i]->b), 1) << RoleName(mark.to);
    EXPECT_LT(LineDistance(to, marks.strokes[i]->a, marks.strokes[i]->b), 1) << RoleName(mark.to);
    EXPECT_GT(glm::dot(marks.strokes[i]->b - marks.strokes[i]->a, to - from), 0) << RoleName(mark.to);
  }
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    ASSERT_TRUE(marks.effectors[i]);
    EXPECT_LT(glm::distance(*marks.effectors[i], *Project(matrix, StandingBody()[EffectorMarks()[i].role])), 0.3);
  }
}

TEST(Annotator, ErrsByItsDeviation) {
  const ProjectionMatrix matrix = MatrixOf(FrontCamera());
  double squares = 0;
  int count = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Marks marks = ReadMarks(Draw(kEverywhere, 2, trial));
    for (std::size_t i = 0; i < kEffectorCount; ++i) {
      ASSERT_TRUE(marks.effectors[i]);
      const glm::dvec2 off = *marks.effectors[i] - *Project(matrix, StandingBody()[EffectorMarks()[i].role]);
      squares += glm::dot(off, off) / 2;
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(squares / count), 2, 0.25);
}

TEST(Annotator, LeavesOutWhatIsNotOnTheExtractedPerson) {
  // The extraction lost everything left of the picture's middle: the person's right arm.
  Mask half(640, 480);
  const ProjectionMatrix matrix = MatrixOf(FrontCamera());
  const double middle = Project(matrix, StandingBody()[Role::kRightShoulder])->x;
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) half.At(x, y) = x > middle;
  }
  const Marks all = ReadMarks(Draw(kEverywhere, 0, 0)), some = ReadMarks(Draw(half, 0, 0));
  auto index_of = [](Role to) {
    return std::find_if(StrokeMarks().begin(), StrokeMarks().end(), [&](const StrokeMark& m) { return m.to == to; }) -
           StrokeMarks().begin();
  };
  EXPECT_TRUE(all.strokes[index_of(Role::kRightWrist)]);
  EXPECT_FALSE(some.strokes[index_of(Role::kRightWrist)]);
  EXPECT_TRUE(some.strokes[index_of(Role::kLeftWrist)]);
  EXPECT_FALSE(some.effectors[3]) << "the right hand";
  EXPECT_TRUE(some.effectors[2]) << "the left hand";
}

TEST(Annotator, ErrsMoreAtAJointItCannotSee) {
  // From the person's left side the right hip is behind the body.
  const Camera side = LookAt({}, {3.8, 1.2, 0}, {0, 0.95, 0});
  BodyPose pose = StandingBody();
  pose[Role::kRightWrist] = {-0.3, 1.05, 0};
  pose[Role::kRightHand] = {-0.25, 0.98, 0};
  const auto body = BodyCapsules(pose);
  ASSERT_TRUE(IsHidden(body, pose, Role::kRightHand, side.p_WC));
  ASSERT_FALSE(IsHidden(body, pose, Role::kLeftHand, side.p_WC));
  double hidden = 0, seen = 0;
  for (int trial = 0; trial < 60; ++trial) {
    RandomStream random({.suite_seed = 5, .scenario = "annotator", .trial = trial}, "annotator");
    const Marks marks = ReadMarks(Annotate(pose, body, side, kEverywhere, {}, random));
    auto squared_error = [&](std::size_t i) {
      if (!marks.effectors[i]) return 0.0;  // covered by another disc
      const glm::dvec2 off = *marks.effectors[i] - *Project(MatrixOf(side), pose[EffectorMarks()[i].role]);
      return glm::dot(off, off);
    };
    seen += squared_error(2);
    hidden += squared_error(3);
  }
  EXPECT_GT(hidden, 4 * seen);
}

TEST(Annotator, ThrowsTheSameDiceWhateverItMarks) {
  // The mask hides the right arm only; every mark on the other side stays where it was.
  Mask half(640, 480);
  for (int y = 0; y < 480; ++y) {
    for (int x = 280; x < 640; ++x) half.At(x, y) = 1;
  }
  const Marks all = ReadMarks(Draw(kEverywhere, 2, 3)), some = ReadMarks(Draw(half, 2, 3));
  ASSERT_TRUE(all.effectors[2] && some.effectors[2]);
  EXPECT_EQ(*all.effectors[2], *some.effectors[2]);
}

TEST(DrawDisc, IsReadBackWhenHalfOfItIsCovered) {
  const auto marks = EffectorMarks();
  for (const glm::dvec2 shift : {glm::dvec2(4, 0), glm::dvec2(0, -3.3), glm::dvec2(2.9, 2.9)}) {
    ColourImage picture(60, 60);
    const glm::dvec2 centre(30.3, 28.8);
    DrawDisc(centre, marks[0], picture);
    DrawDisc(centre + shift, marks[1], picture);
    const Marks read = ReadMarks(picture);
    ASSERT_TRUE(read.effectors[0] && read.effectors[1]);
    EXPECT_LT(glm::distance(*read.effectors[0], centre), 1);
    EXPECT_LT(glm::distance(*read.effectors[1], centre + shift), 0.3);
  }
}

TEST(DrawStroke, IsReadBackWhenAnotherCrossesIt) {
  const auto marks = StrokeMarks();
  ColourImage picture(100, 100);
  const PixelSegment segment{{20, 30}, {80, 62}};
  DrawStroke(segment, marks[0], picture);
  DrawStroke({{25, 80}, {60, 20}}, marks[1], picture);
  const Marks read = ReadMarks(picture);
  ASSERT_TRUE(read.strokes[0]);
  EXPECT_LT(LineDistance(segment.a, read.strokes[0]->a, read.strokes[0]->b), 1);
  EXPECT_LT(LineDistance(segment.b, read.strokes[0]->a, read.strokes[0]->b), 1);
}

TEST(DrawStroke, CutsOffWhatLiesOutside) {
  ColourImage picture(20, 20);
  DrawStroke({{-50, 10}, {70, 10}}, StrokeMarks()[0], picture);
  DrawStroke({{-500, -500}, {-400, -450}}, StrokeMarks()[1], picture);
  DrawDisc({1e9, -1e9}, EffectorMarks()[0], picture);
  EXPECT_TRUE(picture.At(0, 10) == StrokeMarks()[0].first_half);
  EXPECT_TRUE(picture.At(19, 10) == StrokeMarks()[0].second_half);
  EXPECT_TRUE(picture.At(10, 0) == Rgb8{});
}

}  // namespace
}  // namespace etude
