#include "bench/tasks/capture/measure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/tasks/capture/recover.h"
#include "engine/kinematics/tree_to_body.h"

namespace etude {
namespace {

// The tree's body in a pose without straight limbs.
struct Model {
  KinematicTree body = MakeBodyTree({});
  TreeState state = StandingState(body);

  Model() {
    state.root_frame = body.standing_root;
    for (std::size_t i = 0; i < state.angles.size(); ++i) {
      const AngleRange& range = body.limits[i];
      state.angles[i] = 0.5 * (range.lower + range.upper) + 0.2 * (range.upper - range.lower) * std::sin(2.0 * i + 1);
    }
  }
  BodyPose pose() const { return ToBodyPose(body, state); }
};

ProjectionMatrix CameraAt(double degrees, double height) {
  const double a = Radians(degrees);
  return MatrixOf(LookAt({}, {3.8 * std::sin(a), height, 3.8 * std::cos(a)}, {0, 0.9, 0}));
}

Marks ExactMarks(const BodyPose& pose, const ProjectionMatrix& matrix) {
  Marks marks;
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    marks.strokes[i] =
        PixelSegment{*Project(matrix, pose[StrokeMarks()[i].from]), *Project(matrix, pose[StrokeMarks()[i].to])};
  }
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    marks.effectors[i] = Project(matrix, pose[EffectorMarks()[i].role]);
  }
  return marks;
}

TEST(Strokes, AreThoseOfTheLimbsThatTheSkeletonNeeds) {
  ASSERT_EQ(ObservedLimbs().size(), kStrokeCount);
  for (Role limb : ObservedLimbs()) {
    int found = 0;
    for (const StrokeMark& mark : StrokeMarks()) found += mark.to == limb;
    EXPECT_EQ(found, 1) << RoleName(limb);
  }
}

TEST(MeasureFrame, FindsTheTruthInExactMarks) {
  const BodyPose pose = Model().pose();
  const ProjectionMatrix left = CameraAt(-40, 1), right = CameraAt(40, 2.2);
  const FrameMeasurement found = MeasureFrame(ExactMarks(pose, left), left, ExactMarks(pose, right), right);
  const FrameMeasurement truth = TrueMeasurement(pose);
  int checked = 0;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    ASSERT_EQ(found.ends[i].has_value(), truth.ends[i].has_value());
    if (found.ends[i]) {
      EXPECT_LT(glm::distance(*found.ends[i], *truth.ends[i]), 1e-6);
    }
    if (!found.directions[i]) continue;
    EXPECT_LT(Degrees(AngleBetween(*found.directions[i], *truth.directions[i])), 1e-6);
    ++checked;
  }
  EXPECT_GE(checked, 11) << "of thirteen; some may be ill-conditioned";
}

TEST(MeasureFrame, LeavesOutWhatOnePictureLacks) {
  const BodyPose pose = Model().pose();
  const ProjectionMatrix left = CameraAt(-40, 1), right = CameraAt(40, 2.2);
  Marks marks = ExactMarks(pose, left);
  marks.effectors[0].reset();
  marks.strokes[0].reset();
  const FrameMeasurement found = MeasureFrame(marks, left, ExactMarks(pose, right), right);
  EXPECT_FALSE(found.ends[Index(EffectorMarks()[0].role)]);
  EXPECT_FALSE(found.directions[Index(StrokeMarks()[0].to)]);
  EXPECT_TRUE(found.ends[Index(EffectorMarks()[1].role)]);
}

TEST(BridgeGaps, TurnsDirectionsEvenlyAndMovesPointsStraight) {
  const FrameMeasurement first = TrueMeasurement(Model().pose());
  FrameMeasurement last = first;
  last.directions[Index(Role::kHead)] = glm::dvec3(1, 0, 0);
  const glm::dvec3 start(0, 1, 0);
  std::vector<FrameMeasurement> frames(4);
  frames[0] = first;
  frames[0].directions[Index(Role::kHead)] = start;
  frames[3] = last;
  *frames[3].ends[Index(Role::kLeftHand)] += glm::dvec3(0.3, 0, 0);
  const auto bridged = BridgeGaps(frames, 3);
  for (int k = 0; k < 4; ++k) {
    ASSERT_TRUE(bridged[k]) << k;
    const glm::dvec3 head = bridged[k]->directions[Index(Role::kHead)];
    EXPECT_NEAR(Degrees(AngleBetween(head, start)), 30 * k, 1e-9);
    EXPECT_NEAR(glm::length(head), 1, 1e-12);
    const glm::dvec3 moved = bridged[k]->ends[Role::kLeftHand] - *first.ends[Index(Role::kLeftHand)];
    EXPECT_NEAR(moved.x, 0.1 * k, 1e-12);
  }
}

TEST(BridgeGaps, HoldsTheNearestValueAndGivesUpBeyondTheLongestGap) {
  std::vector<FrameMeasurement> frames(10);
  frames[4] = TrueMeasurement(Model().pose());
  const auto bridged = BridgeGaps(frames, 2);
  for (int k = 0; k < 10; ++k) EXPECT_EQ(bridged[k].has_value(), k >= 2 && k <= 6) << k;
  EXPECT_EQ(bridged[2]->ends[Role::kHead], *frames[4].ends[Index(Role::kHead)]);
  // One quantity missing throughout empties every frame.
  frames[4].directions[Index(Role::kLeftKnee)].reset();
  for (const auto& frame : BridgeGaps(frames, 2)) EXPECT_FALSE(frame);
}

TEST(RecoverFrames, GivesAPoseOfTheModelBackAndHoldsItWhereNothingIsSeen) {
  const Model model;
  const std::vector<FrameMeasurement> frames = {TrueMeasurement(model.pose()), {}};
  std::vector<std::optional<LimbObservation>> seen = BridgeGaps(frames, 0);
  ASSERT_TRUE(seen[0]);
  ASSERT_FALSE(seen[1]);
  const auto recovered = RecoverFrames(model.body, {}, seen, {true, true}, *FindIkSolver("ccd"), {});
  ASSERT_TRUE(recovered[0]);
  EXPECT_FALSE(recovered[1]);
  for (Role role : AllRoles()) {
    EXPECT_LT(glm::distance(recovered[0]->fixed[role], model.pose()[role]), 1e-3) << RoleName(role);
    EXPECT_LT(glm::distance(recovered[0]->pose[role], model.pose()[role]), 0.02) << RoleName(role);
  }
  const auto held = HoldFrames(recovered);
  ASSERT_EQ(held.size(), 2u);
  EXPECT_EQ(held[1].pose[Role::kHead], held[0].pose[Role::kHead]);
  EXPECT_TRUE(held[0].effector_error_cm);
  EXPECT_FALSE(held[1].effector_error_cm) << "a held frame met no target";
}

}  // namespace
}  // namespace etude
