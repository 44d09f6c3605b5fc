#include "engine/capture/interpolate_gaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/directions.h"
#include "tests/engine/capture/marked_body.h"

namespace etude {
namespace {

FrameMeasurement WholeMeasurement() {
  const BodyPose pose = ModelPose();
  FrameMeasurement frame;
  for (const EffectorMark& mark : EffectorMarks()) frame.ends[Index(mark.role)] = pose[mark.role];
  for (const StrokeMark& mark : StrokeMarks()) frame.directions[Index(mark.to)] = LimbOf(pose, mark);
  return frame;
}

TEST(InterpolateGaps, TurnsDirectionsEvenlyAndMovesPointsStraight) {
  const FrameMeasurement first = WholeMeasurement();
  FrameMeasurement last = first;
  last.directions[Index(Role::kHead)] = glm::dvec3(1, 0, 0);
  const glm::dvec3 start(0, 1, 0);
  std::vector<FrameMeasurement> frames(4);
  frames[0] = first;
  frames[0].directions[Index(Role::kHead)] = start;
  frames[3] = last;
  *frames[3].ends[Index(Role::kLeftHand)] += glm::dvec3(0.3, 0, 0);
  const auto filled = InterpolateGaps(frames, {.max_gap = 3});
  for (int k = 0; k < 4; ++k) {
    ASSERT_TRUE(filled[k]) << k;
    const glm::dvec3 head = filled[k]->directions[Index(Role::kHead)];
    EXPECT_NEAR(Degrees(AngleBetween(head, start)), 30 * k, 1e-9);
    EXPECT_NEAR(glm::length(head), 1, 1e-12);
    const glm::dvec3 moved = filled[k]->ends[Role::kLeftHand] - *first.ends[Index(Role::kLeftHand)];
    EXPECT_NEAR(moved.x, 0.1 * k, 1e-12);
  }
}

TEST(InterpolateGaps, TakesTheNearerOfTwoOppositeDirections) {
  std::vector<FrameMeasurement> frames(6);
  frames[0] = frames[5] = WholeMeasurement();
  frames[0].directions[Index(Role::kHead)] = glm::dvec3(0, 1, 0);
  frames[5].directions[Index(Role::kHead)] = glm::dvec3(0, -1, 0);
  const auto filled = InterpolateGaps(frames);
  for (int k = 0; k < 6; ++k) EXPECT_EQ(filled[k]->directions[Index(Role::kHead)].y, k < 3 ? 1 : -1) << k;
}

TEST(InterpolateGaps, HoldsTheNearestValueAndGivesUpBeyondTheLongestGap) {
  std::vector<FrameMeasurement> frames(10);
  frames[4] = WholeMeasurement();
  const auto filled = InterpolateGaps(frames, {.max_gap = 2});
  for (int k = 0; k < 10; ++k) EXPECT_EQ(filled[k].has_value(), k >= 2 && k <= 6) << k;
  EXPECT_EQ(filled[2]->ends[Role::kHead], *frames[4].ends[Index(Role::kHead)]);
}

TEST(InterpolateGaps, SaysWhatAFrameLacksAndKeepsTheRest) {
  std::vector<FrameMeasurement> frames(3, WholeMeasurement());
  for (FrameMeasurement& frame : frames) {
    frame.directions[Index(Role::kLeftKnee)].reset();
    frame.ends[Index(Role::kHead)].reset();
  }
  for (const auto& frame : InterpolateGaps(frames)) {
    ASSERT_TRUE(frame);
    for (const StrokeMark& mark : StrokeMarks()) {
      EXPECT_EQ(frame->lacks_direction[Index(mark.to)], mark.to == Role::kLeftKnee) << RoleName(mark.to);
    }
    for (const EffectorMark& mark : EffectorMarks()) {
      EXPECT_EQ(frame->lacks_end[Index(mark.role)], mark.role == Role::kHead) << RoleName(mark.role);
    }
    EXPECT_EQ(frame->directions[Index(Role::kRightKnee)], *frames[0].directions[Index(Role::kRightKnee)]);
  }
}

TEST(InterpolateGaps, PutsAnEndThatOneCameraSeesOnItsSightLine) {
  std::vector<FrameMeasurement> frames(3, WholeMeasurement());
  const std::size_t hand = Index(Role::kLeftHand);
  frames[0].ends[hand] = glm::dvec3(0, 1, 0);
  frames[2].ends[hand] = glm::dvec3(0.2, 1, 0);
  frames[1].ends[hand].reset();
  frames[1].sight_lines[hand] = SightLine{{0, 1.5, 4}, glm::normalize(glm::dvec3(0, -0.5, -4))};
  // The neighbours' middle is (0.1, 1, 0); the line passes through (0, 1, 0) and is normal to X.
  EXPECT_LT(glm::distance(InterpolateGaps(frames)[1]->ends[Role::kLeftHand], {0, 1, 0}), 1e-12);
}

// One plane: the minimiser of (N·d)²/ε² + |d − b|²/τ² is b − N (N·b) / (1 + ε²/τ²), normalised.
TEST(InterpolateGaps, TurnsALimbIntoThePlaneThatOneCameraSeesItIn) {
  const std::size_t head = Index(Role::kHead);
  const GapOptions options{.mark_error_px = 2, .turn_per_frame = Radians(3)};
  for (const int gap : {1, 4}) {
    for (const double length_px : {40.0, 3.0}) {
      std::vector<FrameMeasurement> frames(2 * static_cast<std::size_t>(gap) + 1);
      for (const std::size_t k : {std::size_t{0}, frames.size() - 1}) {
        frames[k] = WholeMeasurement();
        frames[k].directions[head] = glm::dvec3(0, 1, 0);
      }
      const glm::dvec3 normal = glm::normalize(glm::dvec3(1, 0.2, 0));
      const glm::dvec3 ray_a(0, 0, -1), ray_b = glm::normalize(glm::dvec3(0, 0.05, -1));
      frames[static_cast<std::size_t>(gap)].planes[head] = {{normal, ray_a, ray_b, length_px}};
      const double aside = glm::length(glm::cross(glm::normalize(ray_a + ray_b), glm::dvec3(0, 1, 0)));
      const double error = std::max(Radians(1), std::sqrt(2.0) * 2 / length_px * aside);
      const double turn = gap * Radians(3);
      const glm::dvec3 b(0, 1, 0);
      const glm::dvec3 expected =
          glm::normalize(b - normal * glm::dot(normal, b) / (1 + error * error / (turn * turn)));
      const glm::dvec3 found = InterpolateGaps(frames, options)[static_cast<std::size_t>(gap)]->directions[head];
      EXPECT_LT(glm::distance(found, expected), 1e-12) << gap << " " << length_px;
    }
  }
}

// Two planes a degree apart determine the angle across them; the neighbours determine the rest.
TEST(InterpolateGaps, LetsNearlyParallelPlanesTellWhatTheyCan) {
  const std::size_t head = Index(Role::kHead);
  std::vector<FrameMeasurement> frames(3, WholeMeasurement());
  const glm::dvec3 before = glm::normalize(glm::dvec3(0.1, 1, 0.1));
  frames[0].directions[head] = frames[2].directions[head] = before;
  frames[1].directions[head].reset();
  const auto plane = [](const glm::dvec3& normal) {
    return StrokePlane{glm::normalize(normal), {0, 0, -1}, glm::normalize(glm::dvec3(0, 0.1, -1)), 60};
  };
  frames[1].planes[head] = {plane({1, 0, 0}), plane({1, 0, std::tan(Radians(1))})};
  const glm::dvec3 found = InterpolateGaps(frames)[1]->directions[head];
  EXPECT_LT(std::abs(found.x), 0.035) << "it was 0.1; the planes say 0, to ε = 3°/√2 against τ = 3°";
  EXPECT_NEAR(found.z / found.y, before.z / before.y, 0.01);
  EXPECT_NEAR(glm::length(found), 1, 1e-12);
}

TEST(InterpolateGaps, TakesALimbThatNothingElseTellsOfForUnforeshortened) {
  const std::size_t head = Index(Role::kHead);
  std::vector<FrameMeasurement> frames(1, WholeMeasurement());
  frames[0].directions[head].reset();
  const glm::dvec3 a = glm::normalize(glm::dvec3(0, -0.05, -1)), b = glm::normalize(glm::dvec3(0, 0.05, -1));
  frames[0].planes[head] = {{{1, 0, 0}, a, b, 60}};
  EXPECT_LT(glm::distance(InterpolateGaps(frames)[0]->directions[head], {0, 1, 0}), 1e-12);
}

TEST(InterpolateGaps, OneNearNeighbourIsEnoughAndHalfASecondTheDefault) {
  std::vector<FrameMeasurement> frames(40);
  frames[0] = frames[39] = WholeMeasurement();
  const auto filled = InterpolateGaps(frames);
  for (int k = 0; k < 40; ++k) EXPECT_EQ(filled[k].has_value(), k <= 15 || k >= 24) << k;
}

TEST(InterpolateGaps, OfNoFramesIsNone) { EXPECT_TRUE(InterpolateGaps({}).empty()); }

}  // namespace
}  // namespace etude
