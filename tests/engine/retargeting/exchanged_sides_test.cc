#include "engine/retargeting/exchanged_sides.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/retargeting/body_doubts.h"
#include "sim/choreography/move.h"

namespace etude {
namespace {

using enum Role;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kRate_hz = 30;

std::vector<JointPositions> FramesOf(const BodyMotion& motion) {
  std::vector<JointPositions> frames;
  for (const BodyPose& pose : motion.poses) std::ranges::copy(pose.joints, frames.emplace_back().begin());
  return frames;
}

std::vector<JointPositions> Dance(const std::string& move) { return FramesOf(LoadBuiltinMove(move)->motion); }

void Exchange(std::vector<JointPositions>& frames, std::size_t begin, std::size_t end, const std::vector<Role>& left) {
  for (std::size_t f = begin; f < end; ++f) {
    for (const Role role : left) std::swap(frames[f][Index(role)], frames[f][Index(Mirrored(role))]);
  }
}

std::vector<std::pair<Role, std::size_t>> Found(const std::vector<JointPositions>& frames, double rate_hz = kRate_hz) {
  std::vector<std::pair<Role, std::size_t>> found;
  for (const auto& [joint, other, frame] : FindExchanges(frames, rate_hz)) {
    EXPECT_EQ(other, Mirrored(joint));
    found.emplace_back(joint, frame);
  }
  return found;
}

TEST(Exchanges, AreFoundAtTheFramesWhereTheyWereMade) {
  std::vector<JointPositions> frames = Dance("boxing");
  ASSERT_GT(frames.size(), 45u);
  Exchange(frames, 20, 40, {kLeftKnee});
  Exchange(frames, 30, frames.size(), {kLeftShoulder});
  EXPECT_THAT(Found(frames),
              ElementsAre(std::pair(kLeftShoulder, 30u), std::pair(kLeftKnee, 20u), std::pair(kLeftKnee, 40u)));
  EXPECT_THAT(DescribeExchangedJoints(frames, kRate_hz),
              HasSubstr("left and right exchange positions from one frame to the next, 3 times (first at 0.67 s): "
                        "left_shoulder – right_shoulder, left_knee – right_knee"));
  // A single frame, and frames beside a gap.
  frames = Dance("boxing");
  Exchange(frames, 20, 21, {kLeftKnee});
  frames[19][Index(kRightHip)].reset();
  EXPECT_THAT(Found(frames), ElementsAre(std::pair(kLeftKnee, 20u), std::pair(kLeftKnee, 21u)));
  EXPECT_THAT(Found(frames, 5), IsEmpty()) << "so far apart, people change their places";
}

TEST(Exchanges, OfAnyTwoJointsAreFoundAndNameOnlyTheseTwo) {
  int pairs = 0;
  for (const Role joint : AllRoles()) {
    for (const Role other : AllRoles()) {
      if (Index(joint) >= Index(other)) continue;
      std::vector<JointPositions> frames = Dance("boxing");
      // The joints of one pair must be apart, and must not pass each other in these frames.
      const auto apart = [&](std::size_t f) {
        return glm::distance(*frames[f][Index(joint)], *frames[f][Index(other)]);
      };
      if (apart(19) < 0.2 || apart(20) < 0.2 || apart(39) < 0.2 || apart(40) < 0.2) continue;
      for (std::size_t f = 20; f < 40; ++f) std::swap(frames[f][Index(joint)], frames[f][Index(other)]);
      const std::vector<etude::Exchange> found = FindExchanges(frames, kRate_hz);
      ASSERT_EQ(found.size(), 2u) << RoleName(joint) << ", " << RoleName(other);
      for (const auto& one : found) {
        EXPECT_EQ(std::minmax(Index(one.joint), Index(one.other)), std::minmax(Index(joint), Index(other)));
      }
      EXPECT_EQ(found[0].frame, 20u);
      EXPECT_EQ(found[1].frame, 40u);
      ++pairs;
    }
  }
  EXPECT_GT(pairs, 100);
  std::vector<JointPositions> frames = Dance("boxing");
  for (std::size_t f = 20; f < 40; ++f) std::swap(frames[f][Index(kLeftWrist)], frames[f][Index(kLeftElbow)]);
  EXPECT_EQ(DescribeExchangedJoints(frames, kRate_hz),
            "joints exchange positions from one frame to the next, 2 times (first at 0.67 s): left_elbow – left_wrist");
}

TEST(Exchanges, AreNoneOfPeopleWhoCrossTheirArms) {
  for (const char* move : {"aerobic", "boxing", "clap", "fast_sway", "jump", "robot", "side_kick", "sway"}) {
    EXPECT_THAT(Found(Dance(move)), IsEmpty()) << move;
  }
  // Hands that pass each other at 3 m/s are on each other's places in the next frame.
  std::vector<JointPositions> frames = Dance("sway");
  for (std::size_t f = 0; f < 11; ++f) {
    const double x = 0.1 * (static_cast<double>(f) - 4.5);
    frames[f][Index(kLeftWrist)] = glm::dvec3(x, 1, 0.3);
    frames[f][Index(kRightWrist)] = glm::dvec3(-x, 1.01, 0.3);
  }
  frames.resize(11);
  EXPECT_THAT(Found(frames), IsEmpty());
}

TEST(DoubtsOnBody, AreNoneOfBodiesAndNameJointsThatAreNoBodys) {
  for (const char* move : {"aerobic", "boxing", "jump", "robot", "side_kick"}) {
    EXPECT_THAT(DoubtsOnBody(Dance(move), kRate_hz), IsEmpty()) << move;
  }
  // A mirrored axis is noticed; on a body without toes, the knees show it.
  std::vector<JointPositions> mirrored = Dance("side_kick");
  for (JointPositions& frame : mirrored) {
    for (MarkerPosition& place : frame) place->x = -place->x;
  }
  EXPECT_THAT(DoubtsOnBody(mirrored, kRate_hz), Contains(HasSubstr("left and right joints are exchanged")));
  std::vector<JointPositions> squats = Dance("sway");
  for (std::size_t f = 0; f < squats.size(); ++f) {
    for (const Role role : {kLeftFoot, kRightFoot, kSpine, kLeftHand}) squats[f][Index(role)].reset();
    for (const Role role : {kLeftKnee, kRightKnee}) squats[f][Index(role)]->z += 0.25;
  }
  EXPECT_THAT(DoubtsOnBody(squats, kRate_hz), IsEmpty());
  for (JointPositions& frame : squats) {
    for (MarkerPosition& place : frame) {
      if (place) place->z = -place->z;
    }
  }
  EXPECT_THAT(DoubtsOnBody(squats, kRate_hz), ElementsAre(HasSubstr("is an axis mirrored?")));
  // Every role has the position of the next role's joint.
  std::vector<JointPositions> shifted = Dance("boxing");
  for (JointPositions& frame : shifted) std::ranges::rotate(frame, frame.begin() + 1);
  EXPECT_THAT(DoubtsOnBody(shifted, kRate_hz), Contains(HasSubstr("left_foot is torn off in all frames")));
  // Pixels of a picture have no depth.
  std::vector<JointPositions> flat = Dance("boxing");
  for (std::size_t f = 0; f < flat.size(); ++f) {
    for (MarkerPosition& place : flat[f]) place->z = 0.9 + 0.001 * static_cast<double>(f % 7);
  }
  EXPECT_THAT(DoubtsOnBody(flat, kRate_hz), Contains(HasSubstr("the body is flat, without depth")));
  // Lost frames that were filled with the last pose are a freeze; frames without joints are not.
  std::vector<JointPositions> frozen = Dance("boxing");
  std::fill(frozen.begin() + 15, frozen.begin() + 51, frozen[15]);
  EXPECT_THAT(DescribeFreezes(frozen, kRate_hz), HasSubstr("from 0.50 to 1.67 s"));
  EXPECT_THAT(DoubtsOnBody(frozen, kRate_hz), Contains(DescribeFreezes(frozen, kRate_hz)));
  std::fill(frozen.begin() + 15, frozen.begin() + 51, JointPositions{});
  EXPECT_THAT(DescribeFreezes(frozen, kRate_hz), IsEmpty());
  // Frames without points give no message, nor does a recording without frames.
  EXPECT_THAT(DoubtsOnBody(std::vector<JointPositions>(20), kRate_hz), IsEmpty());
  EXPECT_THAT(DoubtsOnBody({}, kRate_hz), IsEmpty());
}

}  // namespace
}  // namespace etude
