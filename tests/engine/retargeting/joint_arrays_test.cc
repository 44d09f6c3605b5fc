#include "engine/retargeting/joint_arrays.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <tuple>

#include "engine/retargeting/markers.h"
#include "tests/engine/formats/spoilt.h"
#include "tests/support/results.h"

namespace etude::joint_arrays {
namespace {

using ::testing::HasSubstr;

/// Returns a person who stands straight and faces +Z, with the lowest joint at height 0; metres, Y up.
BodyPose Straight() {
  using enum Role;
  BodyPose pose;
  pose[kHipCentre] = {0, .9, 0};
  pose[kSpine] = {0, 1.15, 0};
  pose[kShoulderCentre] = {0, 1.4, 0};
  pose[kHead] = {0, 1.6, 0};
  for (const double side : {1.0, -1.0}) {
    const auto of = [&](Role role) { return side > 0 ? role : Mirrored(role); };
    pose[of(kLeftShoulder)] = {side * .18, 1.4, 0};
    pose[of(kLeftElbow)] = {side * .2, 1.12, 0};
    pose[of(kLeftWrist)] = {side * .2, .87, 0};
    pose[of(kLeftHand)] = {side * .2, .78, 0};
    pose[of(kLeftHip)] = {side * .09, .9, 0};
    pose[of(kLeftKnee)] = {side * .09, .48, 0};
    pose[of(kLeftAnkle)] = {side * .09, .05, 0};
    pose[of(kLeftFoot)] = {side * .09, 0, .13};
  }
  return pose;
}

/// Returns a person's joints in the order of a layout, in `frames` frames; joints without a role are near the head.
NumberArray InOrderOf(const std::vector<std::string>& layout, std::size_t frames, double noise_m, testing::Dice& dice) {
  const BodyPose pose = Straight();
  NumberArray array{.shape = {frames, layout.size(), 3}, .values = {}};
  for (std::size_t f = 0; f < frames; ++f) {
    for (const std::string& name : layout) {
      const auto role = FindRole(name);
      const glm::dvec3 place = role ? pose[*role] : pose[Role::kHead] + glm::dvec3(0, 0, 0.05);
      for (int axis = 0; axis < 3; ++axis) array.values.push_back(place[axis] + noise_m * dice.Signed());
    }
  }
  return array;
}

TEST(JointArrays, InAnotherOrderThanTheLayoutsAreRefusedWithTheOneThatFits) {
  testing::Dice dice(3);
  // Noise of ±15 cm for each coordinate changes the lengths of limbs by more than 30 %.
  for (const double noise_m : {0.0, 0.05, 0.15}) {
    for (const auto& [layout, joints, usual] : {std::tuple("kinect_v2", 25u, "body_25"),
                                                {"lafan1", 22u, "smpl"},
                                                {"smpl_humanoid", 24u, "smpl"},
                                                {"h36m", 17u, "coco"}}) {
      const NumberArray array = InOrderOf(JointsOfLayout(layout, joints), 60, noise_m, dice);
      const auto wrong = JointsOfArray(array, usual, "a.npy");
      EXPECT_EQ(testing::Refusal(wrong), fmt::format("a.npy: in the layout {}, limbs have impossible lengths; allowed: "
                                                     "a.npy#{}, in which the limbs have possible lengths",
                                                     usual, layout))
          << noise_m;
      ASSERT_OK(right, JointsOfArray(array, layout, "a.npy"));
      EXPECT_EQ(right->layout, layout);
    }
    // Controls: noise never makes the right layout a wrong one.
    for (const auto& [layout, joints] : {std::pair("etude", 20u),
                                         {"smpl", 22u},
                                         {"smpl", 24u},
                                         {"h36m", 17u},
                                         {"coco", 17u},
                                         {"mhr70", 70u},
                                         {"mhr", 127u}}) {
      EXPECT_TRUE(JointsOfArray(InOrderOf(JointsOfLayout(layout, joints), 60, noise_m, dice), layout, "a.npy"))
          << layout;
    }
  }
  // Jaw and eye are no hands.
  EXPECT_THAT(testing::Refusal(JointsOfArray(InOrderOf(JointsOfLayout("smplx", 24), 9, 0, dice), {}, "a.npy")),
              HasSubstr("a.npy#smplx, in which the limbs have possible lengths"));
}

TEST(JointArrays, OfTwoPeopleInOnePictureAreDoubted) {
  testing::Dice dice(4);
  const auto doubt = [&](std::size_t frames, const glm::dvec3& step, double noise_m) {
    NumberArray array = InOrderOf(JointsOfLayout("smpl", 22), frames, noise_m, dice);
    for (std::size_t i = 0; i < array.values.size(); ++i) {
      array.values[i] += static_cast<double>(i / 66) * step[static_cast<int>(i % 3)];
    }
    return DescribeFewFrames(JointsOfArray(array, {}, "a.npy")->motion);
  };
  EXPECT_EQ(
      doubt(2, {0.6, 0, 0.8}, 0),
      "in each of the 2 frames, most joints jump by at least 100 cm to the next frame: does the first axis of the "
      "array count people instead of frames?");
  EXPECT_EQ(doubt(1, {1, 0, 0}, 0), "");
  EXPECT_EQ(doubt(2, {0.2, 0, 0}, 0.02), "") << "runs at 6 m/s";
  EXPECT_EQ(doubt(40, {1, 0, 0}, 0), "") << "a film";
}

TEST(JointArrays, OfOtherLayoutsHaveNoConventionOfAxesAndFloor) {
  testing::Dice dice(5);
  const auto body_of = [&](const char* layout, std::size_t joints, const std::function<glm::dvec3(glm::dvec3)>& place) {
    NumberArray array = InOrderOf(JointsOfLayout(layout, joints), 60, 0, dice);
    for (std::size_t i = 0; i < array.values.size(); i += 3) {
      const glm::dvec3 p = place({array.values[i], array.values[i + 1], array.values[i + 2]});
      for (int axis = 0; axis < 3; ++axis) array.values[i + static_cast<std::size_t>(axis)] = p[axis];
    }
    auto joints_of = JointsOfArray(array, layout, "a.npy").value();
    return FindMarkerBodies(joints_of.motion, "a.npy",
                            {.up = ArrayUp(), .layout = joints_of.layout, .is_of_camera = joints_of.is_of_camera})
        ->front();
  };
  const auto z_up = [](const glm::dvec3& p) { return glm::dvec3(p.x, -p.z, p.y); };
  for (const auto& [layout, joints] : {std::pair("smpl", 22u), {"h36m", 17u}}) {
    const MarkerBody body = body_of(layout, joints, z_up);
    EXPECT_EQ(body.changes.front(), std::string("layout ") + layout);
    EXPECT_EQ(AxisName(body.up.axis), "Z");
    EXPECT_THAT(body.up.doubt, HasSubstr("Y is the usual axis of arrays of joints"));
    EXPECT_LT(glm::distance(body.motion.poses[7][Role::kLeftWrist] - body.motion.poses[7][Role::kLeftKnee],
                            Straight()[Role::kLeftWrist] - Straight()[Role::kLeftKnee]),
              1e-9);
  }
  const MarkerBody own = body_of("etude", 20, z_up);
  EXPECT_EQ(AxisName(own.up.axis), "Y");
  EXPECT_THAT(own.up.doubt, HasSubstr("the convention of Etude's own joints"));
  // In a camera's frame, and relative to the hips, height 0 is not that of a floor: the body is put on its floor.
  const auto lowest = [](const MarkerBody& body) {
    double y = 9;
    for (const glm::dvec3& joint : body.motion.poses.front().joints) y = std::min(y, joint.y);
    return y;
  };
  const auto camera = [](const glm::dvec3& p) { return glm::dvec3(p.x, 0.2 - p.y, 4 - p.z); };
  const auto relative = [](const glm::dvec3& p) { return p - Straight()[Role::kHipCentre]; };
  for (const char* layout : {"smpl", "etude"}) {
    for (const bool is_camera : {true, false}) {
      const MarkerBody body = is_camera ? body_of(layout, layout[0] == 's' ? 22 : 20, camera)
                                        : body_of(layout, layout[0] == 's' ? 22 : 20, relative);
      EXPECT_FALSE(body.is_floor_known);
      EXPECT_NEAR(lowest(body), 0, 1e-9) << layout << is_camera;
    }
  }
  EXPECT_TRUE(body_of("smpl", 22, [](const glm::dvec3& p) { return p; }).is_floor_known);
}

}  // namespace
}  // namespace etude::joint_arrays
