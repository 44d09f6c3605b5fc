#include "engine/capture/bridge_gaps.h"

#include <gtest/gtest.h>

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

TEST(BridgeGaps, TurnsDirectionsEvenlyAndMovesPointsStraight) {
  const FrameMeasurement first = WholeMeasurement();
  FrameMeasurement last = first;
  last.directions[Index(Role::kHead)] = glm::dvec3(1, 0, 0);
  const glm::dvec3 start(0, 1, 0);
  std::vector<FrameMeasurement> frames(4);
  frames[0] = first;
  frames[0].directions[Index(Role::kHead)] = start;
  frames[3] = last;
  *frames[3].ends[Index(Role::kLeftHand)] += glm::dvec3(0.3, 0, 0);
  const auto bridged = BridgeGaps(frames, {.longest_gap = 3});
  for (int k = 0; k < 4; ++k) {
    ASSERT_TRUE(bridged[k]) << k;
    const glm::dvec3 head = bridged[k]->directions[Index(Role::kHead)];
    EXPECT_NEAR(Degrees(AngleBetween(head, start)), 30 * k, 1e-9);
    EXPECT_NEAR(glm::length(head), 1, 1e-12);
    const glm::dvec3 moved = bridged[k]->ends[Role::kLeftHand] - *first.ends[Index(Role::kLeftHand)];
    EXPECT_NEAR(moved.x, 0.1 * k, 1e-12);
  }
}

TEST(BridgeGaps, TakesTheNearerOfTwoOppositeDirections) {
  std::vector<FrameMeasurement> frames(6);
  frames[0] = frames[5] = WholeMeasurement();
  frames[0].directions[Index(Role::kHead)] = glm::dvec3(0, 1, 0);
  frames[5].directions[Index(Role::kHead)] = glm::dvec3(0, -1, 0);
  const auto bridged = BridgeGaps(frames);
  for (int k = 0; k < 6; ++k) EXPECT_EQ(bridged[k]->directions[Index(Role::kHead)].y, k < 3 ? 1 : -1) << k;
}

TEST(BridgeGaps, HoldsTheNearestValueAndGivesUpBeyondTheLongestGap) {
  std::vector<FrameMeasurement> frames(10);
  frames[4] = WholeMeasurement();
  const auto bridged = BridgeGaps(frames, {.longest_gap = 2});
  for (int k = 0; k < 10; ++k) EXPECT_EQ(bridged[k].has_value(), k >= 2 && k <= 6) << k;
  EXPECT_EQ(bridged[2]->ends[Role::kHead], *frames[4].ends[Index(Role::kHead)]);
  // One quantity missing throughout empties every frame.
  frames[4].directions[Index(Role::kLeftKnee)].reset();
  for (const auto& frame : BridgeGaps(frames, {.longest_gap = 2})) EXPECT_FALSE(frame);
}

TEST(BridgeGaps, OneNearNeighbourIsEnoughAndHalfASecondTheDefault) {
  std::vector<FrameMeasurement> frames(40);
  frames[0] = frames[39] = WholeMeasurement();
  const auto bridged = BridgeGaps(frames);
  for (int k = 0; k < 40; ++k) EXPECT_EQ(bridged[k].has_value(), k <= 15 || k >= 24) << k;
}

TEST(BridgeGaps, OfNoFramesIsNone) { EXPECT_TRUE(BridgeGaps({}).empty()); }

}  // namespace
}  // namespace etude
