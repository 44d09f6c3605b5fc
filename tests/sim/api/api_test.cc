// etude::sim returns what the simulation returns, and refuses with a reason what cannot be simulated.
#include <etude/sim/pictures.h>
#include <etude/sim/sensor.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "sim/choreography/canonical_body.h"
#include "sim/rig/rig.h"
#include "sim/skeleton_sensor/skeleton_sensor.h"
#include "tests/support/refusal.h"

namespace etude::sim {
namespace {

using etude::testing::RefusalOf;
using ::testing::HasSubstr;

/// Returns a person who glides sideways, 3 m from the origin.
BodyMotion Gliding() {
  BodyMotion motion{.rate_hz = 30, .poses = {}};
  for (int frame = 0; frame < 40; ++frame) {
    BodyPose& pose = motion.poses.emplace_back();
    pose = PoseOf(Controls{});
    for (glm::dvec3& joint : pose.joints) joint.x += 3 + 0.005 * frame;
  }
  return motion;
}

TEST(SimulatedSensor, ReportsWhatTheSimulationsOwnDoes) {
  const BodyMotion motion = Gliding();
  const auto reports = SenseSkeleton(motion, {.sensor = "v1", .distance_m = 2, .turn = 0.3, .seed = 5});
  Camera eye = SkeletonSensorAt({.distance = 2, .turn = 0.3}, FindSensorPreset("v1")->view);
  eye.p_WC += MiddleOnFloor(motion.poses);
  const auto own =
      etude::SenseSkeleton(motion, eye, {}, *FindSensorPreset("v1"), {.suite_seed = 5, .scenario = "library"});
  ASSERT_EQ(reports.frames.size(), own.frames.size());
  for (std::size_t frame = 0; frame < reports.frames.size(); ++frame) {
    for (std::size_t joint = 0; joint < kRoleCount; ++joint) {
      EXPECT_EQ(reports.frames[frame].joints[joint].state, own.frames[frame].joints[joint].state);
      EXPECT_EQ(reports.frames[frame].joints[joint].position, own.frames[frame].joints[joint].position);
    }
  }
  EXPECT_NE(MotionOf(SenseSkeleton(motion, {.sensor = "v1", .seed = 6})).poses[20].joints,
            MotionOf(reports).poses[20].joints);
}

TEST(SimulatedSensor, WithoutErrorsTellsTheTruth) {
  const BodyMotion motion = Gliding();
  const auto reports = SenseSkeleton(motion, {.strength = 0});
  for (std::size_t frame = 0; frame < reports.frames.size(); ++frame) {
    for (std::size_t joint = 0; joint < kRoleCount; ++joint) {
      EXPECT_NEAR(glm::distance(reports.frames[frame].joints[joint].position, motion.poses[frame].joints[joint]), 0,
                  1e-9);
    }
  }
}

TEST(SimulatedSensor, RefusesWhatItCannotSense) {
  EXPECT_THAT(RefusalOf([] { SenseSkeleton({}); }), HasSubstr("without frames"));
  EXPECT_THAT(RefusalOf([] { SenseSkeleton(Gliding(), {.distance_m = 50}); }), HasSubstr("50; allowed: 0.5 to 10"));
  EXPECT_THAT(RefusalOf([] { SenseSkeleton(Gliding(), {.strength = std::numeric_limits<double>::quiet_NaN()}); }),
              HasSubstr("strength nan; allowed: 0 to 10"));
  EXPECT_THAT(RefusalOf([] { SenseSkeleton(Gliding(), {.sensor = "v3: 1"}); }), HasSubstr("sensor:1"));
}

TEST(SimulatedStudio, ShowsThePersonWhereTheCamerasSeeTheBody) {
  const BodyMotion motion = Gliding();
  const auto cameras = StereoCameras(motion, 0.5);
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_NEAR(glm::distance(cameras[0].camera.p_WC, cameras[1].camera.p_WC), 0.5, 0.2);
  const Studio studio(motion, cameras);
  for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
    const Picture picture = studio.Shoot(camera, 39), before = studio.ShootEmpty(camera);
    ASSERT_EQ(picture.person.pixels.size(), std::size_t{640} * 480);
    ASSERT_EQ(picture.colour.pixels.size(), picture.person.pixels.size());
    EXPECT_EQ(std::ranges::count(before.person.pixels, 1), 0);
    for (const Role role : {Role::kHead, Role::kSpine, Role::kRightElbow}) {
      const glm::dvec2 pixel = Project(cameras[camera].camera, motion.poses[39][role]).value();
      const glm::ivec2 at(pixel);
      EXPECT_EQ(picture.person.At(at.x, at.y), 1);
      EXPECT_NE(picture.colour.At(at.x, at.y), before.colour.At(at.x, at.y));
    }
    EXPECT_EQ(studio.Shoot(camera, 39).colour.pixels, picture.colour.pixels);
  }
}

TEST(SimulatedStudio, RefusesWhatItCannotDraw) {
  const BodyMotion motion = Gliding();
  NamedCamera lens;
  lens.camera.distortion.k1 = -0.1;
  EXPECT_THAT(RefusalOf([&] { Studio(motion, std::array{lens}); }), HasSubstr("the lens has distortion"));
  EXPECT_THAT(RefusalOf([&] { Studio(motion, {}); }), HasSubstr("no camera"));
  EXPECT_THAT(RefusalOf([&] { StereoCameras(motion, 0); }), HasSubstr("baseline is 0 m"));
  const Studio studio(motion, StereoCameras(motion));
  EXPECT_THAT(RefusalOf([&] { studio.Shoot(2, 0); }), HasSubstr("camera 2; allowed: 0 to 1"));
  EXPECT_THAT(RefusalOf([&] { studio.Shoot(0, 40); }), HasSubstr("frame 40; allowed: 0 to 39"));
}

}  // namespace
}  // namespace etude::sim
