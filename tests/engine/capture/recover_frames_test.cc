#include "engine/capture/recover_frames.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/engine/capture/marked_body.h"
#include "tests/support/gaps.h"

namespace etude {
namespace {

LimbObservation Observe(const BodyPose& pose) {
  LimbObservation observation{pose, {}};
  for (const StrokeMark& mark : StrokeMarks()) observation.directions[Index(mark.to)] = LimbOf(pose, mark);
  return observation;
}

RecoverOptions With(const char* solver) { return {.solver = FindIkSolver(solver), .ik = {}}; }

TEST(RecoverFrames, GivesAPoseOfTheModelBackAndHoldsItWhereNothingIsSeen) {
  const BodyPose pose = ModelPose();
  const std::vector<std::optional<LimbObservation>> seen = {Observe(pose), std::nullopt};
  const auto recovered = RecoverFrames({.body = PaperBody({}), .seen = seen}, With("ccd"));
  ASSERT_TRUE(recovered[0]);
  EXPECT_FALSE(recovered[1]);
  EXPECT_LT(WorstJointDistance(recovered[0]->fixed, pose), 1e-3);
  EXPECT_LT(WorstJointDistance(recovered[0]->pose, pose), 0.02);
  const auto held = RepeatLastPose(recovered);
  ASSERT_EQ(held.size(), 2u);
  EXPECT_EQ(held[1].pose[Role::kHead], held[0].pose[Role::kHead]);
  EXPECT_EQ(held[0].errors.size(), 4u);
  EXPECT_TRUE(held[1].errors.empty()) << "a held frame met no target";
}

TEST(RepeatLastPose, ShowsTheFirstSkeletonBeforeItAndTheLastOneAfterIt) {
  const std::vector<std::optional<LimbObservation>> seen = {std::nullopt, Observe(ModelPose(0)), std::nullopt,
                                                            Observe(ModelPose(1)), std::nullopt};
  const auto recovered = RecoverFrames({.body = PaperBody({}), .seen = seen}, With("ccd"));
  const auto held = RepeatLastPose(recovered);
  const int shown[] = {1, 1, 1, 3, 3};
  for (int k = 0; k < 5; ++k) EXPECT_EQ(held[k].pose.joints, recovered[shown[k]]->pose.joints) << k;
}

// With a solver that does nothing, the result is each frame's start.
TEST(RecoverFrames, StartsMarkedFramesFromTheirPicturesAndOthersFromTheLastFrame) {
  const IkSolver idle{.name = "idle",
                      .description = "",
                      .step = "steps",
                      .settings = {},
                      .solve = [](const KinematicTree&, const IkProblem& problem, const IkOptions&) {
                        IkSolution solution{.status = IkStatus::kStalled, .angles = problem.start.angles};
                        return solution;
                      }};
  const std::vector<std::optional<LimbObservation>> seen = {Observe(ModelPose(0)), Observe(ModelPose(1)),
                                                            Observe(ModelPose(2))};
  const auto frames =
      RecoverFrames({.body = PaperBody({}), .seen = seen, .marked = {true, false, true}}, {.solver = &idle});
  EXPECT_EQ(frames[1]->state.angles, frames[0]->state.angles);
  EXPECT_NE(frames[2]->state.angles, frames[1]->state.angles);
  EXPECT_LT(glm::distance(frames[1]->pose[Role::kLeftFoot], ModelPose(1)[Role::kLeftFoot]), 1e-9)
      << "the root is always where it was seen";
  const std::vector<std::optional<LimbObservation>> with_gap = {seen[0], seen[1], std::nullopt, seen[2]};
  const auto after_gap =
      RecoverFrames({.body = PaperBody({}), .seen = with_gap, .marked = {true, true, false, false}}, {.solver = &idle});
  EXPECT_EQ(after_gap[3]->state.angles, after_gap[1]->state.angles) << "of the last frame that was recovered";
  const auto all_marked = RecoverFrames({.body = PaperBody({}), .seen = seen}, {.solver = &idle});
  EXPECT_NE(all_marked[1]->state.angles, all_marked[0]->state.angles);
}

/// Returns the observation without one end or one limb, marked as InterpolateGaps expects.
LimbObservation Lacking(LimbObservation seen, std::optional<Role> end, std::optional<Role> limb) {
  if (end) {
    seen.ends[*end] = glm::dvec3(0);
    seen.lacks_end[Index(*end)] = true;
  }
  if (limb) {
    seen.directions[Index(*limb)] = glm::dvec3(0);
    seen.lacks_direction[Index(*limb)] = true;
  }
  return seen;
}

TEST(RecoverFrames, MakesASkeletonOfWhatThereIs) {
  for (const StrokeMark& mark : StrokeMarks()) {
    const BodyPose pose = ModelPose(), next = ModelPose(0.05);
    const std::vector<std::optional<LimbObservation>> seen = {
        Observe(pose), Lacking(Observe(next), std::nullopt, mark.to), Lacking(Observe(next), mark.to, std::nullopt)};
    const auto frames = RecoverFrames({.body = PaperBody({}), .seen = seen}, With("damped-least-squares"));
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_TRUE(frames[k]) << RoleName(mark.to);
      for (Role role : AllRoles()) {
        EXPECT_LT(glm::distance(frames[k]->pose[role], (k == 0 ? pose : next)[role]), 0.05)
            << RoleName(role) << " without " << RoleName(mark.to) << " in frame " << k;
      }
    }
  }
}

TEST(RecoverFrames, CountsNoErrorAtAnEndThatWasNotSeen) {
  const std::vector<std::optional<LimbObservation>> seen = {
      Observe(ModelPose()), Lacking(Observe(ModelPose(0.1)), Role::kLeftHand, std::nullopt)};
  const auto frames = RecoverFrames({.body = PaperBody({}), .seen = seen}, With("ccd"));
  EXPECT_EQ(frames[0]->errors.size(), 4u);
  EXPECT_EQ(frames[1]->errors.size(), 3u);
}

TEST(RecoverFrames, BeginsAsAStandingBodyWhereNothingElseIsKnown) {
  LimbObservation only_a_foot;
  only_a_foot.lacks_end.fill(true);
  only_a_foot.lacks_direction.fill(true);
  LimbObservation nothing = only_a_foot;
  only_a_foot.ends[Role::kRightFoot] = {0.4, 0, 0.2};
  only_a_foot.lacks_end[Index(Role::kRightFoot)] = false;
  const std::vector<std::optional<LimbObservation>> seen = {nothing, only_a_foot, nothing};
  const auto frames = RecoverFrames({.body = PaperBody({}), .seen = seen}, With("damped-least-squares"));
  EXPECT_FALSE(frames[0]) << "nothing tells where the body is";
  ASSERT_TRUE(frames[1] && frames[2]);
  const BodyPose standing = ToBodyPose(MakeBodyTree({}), StandingState(MakeBodyTree({})));
  const glm::dvec3 shift = glm::dvec3(0.4, 0, 0.2) - standing[Role::kRightFoot];
  for (Role role : AllRoles()) {
    EXPECT_LT(glm::distance(frames[1]->pose[role], standing[role] + shift), 0.01) << RoleName(role);
    EXPECT_LT(glm::distance(frames[2]->pose[role], frames[1]->pose[role]), 0.01) << RoleName(role);
  }
}

TEST(RecoverFrames, LeavesOutWhatNoBodyFits) {
  LimbObservation broken = Observe(ModelPose());
  broken.directions[Index(Role::kHead)] = glm::dvec3(0);
  const std::vector<std::optional<LimbObservation>> seen = {broken, Observe(ModelPose())};
  const auto frames = RecoverFrames({.body = PaperBody({}), .seen = seen}, With("ccd"));
  EXPECT_FALSE(frames[0]);
  EXPECT_TRUE(frames[1]);
}

constexpr int kFrames = 12;

std::vector<FrameMeasurement> Measured(double phase_step, const std::vector<int>& unmarked) {
  std::vector<BodyPose> poses;
  for (int k = 0; k < kFrames; ++k) poses.push_back(ModelPose(phase_step * k));
  const std::vector<ProjectionMatrix> cameras = ThreeCameras();
  TakeMarks marks = ExactMarks(poses, cameras);
  for (auto& of_camera : marks) {
    for (const int k : unmarked) of_camera[static_cast<std::size_t>(k)] = {};
  }
  MeasureOptions options;
  options.min_plane_angle = Radians(0.1);  // exact marks need no margin
  return MeasureFrames({.cameras = cameras, .marks = marks}, options);
}

RecoverOptions Options() { return {.solver = FindIkSolver("ccd"), .ik = {}}; }

std::vector<std::optional<RecoveredFrame>> Live(const CaptureBody& body,
                                                const std::vector<FrameMeasurement>& measured) {
  LiveRecovery live(body, Options(), {});
  std::vector<std::optional<RecoveredFrame>> frames;
  for (const FrameMeasurement& frame : measured) frames.push_back(live.Next(frame));
  return frames;
}

std::vector<std::optional<RecoveredFrame>> Whole(const CaptureBody& body,
                                                 const std::vector<FrameMeasurement>& measured) {
  const auto seen = InterpolateGaps(measured);
  return RecoverFrames({.body = body, .seen = seen}, Options());
}

TEST(LiveRecovery, GivesWhatTheWholeTakeGivesWhereEveryFrameShowsEverything) {
  const CaptureBody body = PaperBody({});
  const auto measured = Measured(0.1, {});
  const auto live = Live(body, measured), whole = Whole(body, measured);
  for (int k = 0; k < kFrames; ++k) EXPECT_EQ(live[k]->pose.joints, whole[k]->pose.joints) << k;
}

TEST(LiveRecovery, IsNotChangedByLaterFramesAsTheWholeTakeIs) {
  const CaptureBody body = PaperBody({});
  auto measured = Measured(0.1, {5, 6}), other = measured;
  const auto later = Measured(0.3, {});
  for (int k = 7; k < kFrames; ++k) other[k] = later[k];
  const auto live = Live(body, measured), live_other = Live(body, other);
  for (int k = 0; k < 7; ++k) EXPECT_EQ(live[k]->pose.joints, live_other[k]->pose.joints) << k;
  EXPECT_NE(live[8]->pose.joints, live_other[8]->pose.joints);
  const auto whole = Whole(body, measured), whole_other = Whole(body, other);
  EXPECT_NE(whole[5]->pose.joints, whole_other[5]->pose.joints) << "the control: it looks ahead";
}

TEST(ExtrapolateLast, IsWhatGapsAreBridgedWithWhenNothingFollowsHoweverFewFramesAreKept) {
  auto measured = Measured(0.1, {3, 4, 9, 10, 11});
  const GapOptions options{.max_gap = 3};
  for (std::size_t count = 1; count <= measured.size(); ++count) {
    const std::span<const FrameMeasurement> first(measured.data(), count);
    const auto last = ExtrapolateLast(first, options), whole = InterpolateGaps(first, options).back();
    const auto kept = ExtrapolateLast(first.last(std::min<std::size_t>(count, 4)), options);
    ASSERT_EQ(last.has_value(), whole.has_value());
    if (!last) continue;
    EXPECT_EQ(last->ends.joints, whole->ends.joints) << count;
    EXPECT_EQ(last->ends.joints, kept->ends.joints) << count;
    EXPECT_EQ(last->directions, whole->directions) << count;
  }
}

}  // namespace
}  // namespace etude
