#include "engine/cameras/planes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "sim/random/stream.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

std::vector<Camera> TrueCameras() {
  Intrinsics in{.width = 640, .height = 480, .fx = 610, .fy = 590, .cx = 327, .cy = 231, .skew = 0};
  std::vector<Camera> cameras{LookAt(in, {0, 1, 3}, {0, 1, 0})};
  in.fx = in.fy = 700;
  cameras.push_back(LookAt(in, {2, 1.4, 2.4}, {0, 1, 0}));
  cameras.push_back(LookAt(in, {-2, 0.8, 2.4}, {0, 1, 0}));
  for (Camera& camera : cameras) camera.distortion = {.k1 = -0.1, .k2 = 0.03, .p1 = 0.001, .p2 = -0.001};
  return cameras;
}

CalibrationTargetPose AnyPose(RandomStream& dice) {
  const glm::dquat turn = glm::angleAxis(dice.Uniform(-0.6, 0.6), glm::dvec3(0, 1, 0)) *
                          glm::angleAxis(dice.Uniform(-0.6, 0.6), glm::dvec3(1, 0, 0)) *
                          glm::angleAxis(dice.Uniform(-0.3, 0.3), glm::dvec3(0, 0, 1));
  // The board's z axis points away from a viewer in front.
  const glm::dmat3 facing(glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, -1));
  return {glm::mat3_cast(turn) * facing, {dice.Uniform(-0.4, 0.2), dice.Uniform(0.9, 1.5), dice.Uniform(-0.3, 0.3)}};
}

std::vector<TargetView> Views(const std::vector<Camera>& cameras, int boards, double sigma_px, int seed = 1) {
  RandomStream dice(WorldKey{.suite_seed = 1, .scenario = "planes", .trial = seed}, "boards");
  RandomStream errors(WorldKey{.suite_seed = 1, .scenario = "planes", .trial = seed}, "errors");
  std::vector<TargetView> views;
  for (int b = 0; b < boards; ++b) {
    const CalibrationTargetPose pose = AnyPose(dice);
    for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
      TargetView view{camera, static_cast<std::size_t>(b), {}};
      for (int i = 0; i < 35; ++i) {
        const glm::dvec3 place(0.06 * (i % 7), 0.06 * (i / 7), 0);
        const auto pixel = Project(cameras[camera], pose.R_WT * place + pose.p_WT);
        if (pixel) view.pairs.push_back({place, *pixel + sigma_px * glm::dvec2(errors.Normal(), errors.Normal())});
      }
      views.push_back(std::move(view));
    }
  }
  return views;
}

const std::vector<PictureSize> kSizes(3, PictureSize{640, 480});

TEST(Planes, AHomographyShowsThePointsThatItWasMadeOf) {
  const std::vector<Camera> pinhole{LookAt({}, {0, 1, 3}, {0, 1, 0})};
  const TargetView view = Views(pinhole, 1, 0).front();
  ASSERT_OK(H, HomographyOf(view.pairs));
  for (const PointPair& pair : view.pairs) {
    const glm::dvec3 p = *H * glm::dvec3(pair.world.x, pair.world.y, 1);
    EXPECT_LT(glm::distance(glm::dvec2(p) / p.z, pair.pixel), 1e-8);
  }
}

TEST(Planes, APoseComesBackFromItsHomography) {
  const std::vector<Camera> pinhole{LookAt({}, {0.4, 1.2, 2.5}, {0, 1, 0})};
  RandomStream dice(WorldKey{.suite_seed = 1, .scenario = "planes", .trial = 1}, "boards");
  const CalibrationTargetPose pose = AnyPose(dice);
  const CalibrationTargetPose found =
      PoseOfPlane(pinhole[0].intrinsics, *HomographyOf(Views(pinhole, 1, 0).front().pairs));
  const glm::dmat3 R_CT = pinhole[0].R_CW * pose.R_WT;
  for (int i = 0; i < 3; ++i) EXPECT_LT(glm::distance(found.R_WT[i], R_CT[i]), 1e-8);
  EXPECT_LT(glm::distance(found.p_WT, pinhole[0].R_CW * (pose.p_WT - pinhole[0].p_WC)), 1e-8);
}

TEST(Planes, CamerasComeBackFromExactCorners) {
  const std::vector<Camera> cameras = TrueCameras();
  ASSERT_OK(rig, CalibrateFromPlanes(kSizes, Views(cameras, 8, 0)));
  EXPECT_LT(rig->rms_px, 1e-9);
  EXPECT_EQ(rig->parameters, 3u * 14 + 7 * 6);
  RandomStream dice(WorldKey{.suite_seed = 1, .scenario = "planes", .trial = 1}, "boards");
  const CalibrationTargetPose world = AnyPose(dice);  // the first board is the rig's world
  for (std::size_t i = 0; i < 3; ++i) {
    const Camera &found = rig->cameras[i], &wanted = cameras[i];
    EXPECT_NEAR(found.intrinsics.fx, wanted.intrinsics.fx, 1e-6);
    EXPECT_NEAR(found.intrinsics.cy, wanted.intrinsics.cy, 1e-6);
    EXPECT_NEAR(found.distortion.k1, wanted.distortion.k1, 1e-9);
    EXPECT_NEAR(found.distortion.p2, wanted.distortion.p2, 1e-9);
    EXPECT_LT(glm::distance(world.R_WT * found.p_WC + world.p_WT, wanted.p_WC), 1e-8);
  }
}

TEST(Planes, TheResidualOfNoisyCornersIsTheirNoiseLessTheParameters) {
  constexpr double kSigma = 0.3;
  double sum = 0, freedom = 0;
  for (int seed = 1; seed <= 12; ++seed) {
    ASSERT_OK(rig, CalibrateFromPlanes(kSizes, Views(TrueCameras(), 8, kSigma, seed)));
    sum += rig->rms_px * rig->rms_px * static_cast<double>(rig->points) / (kSigma * kSigma);
    freedom += 2.0 * static_cast<double>(rig->points) - static_cast<double>(rig->parameters);
  }
  EXPECT_NEAR(sum, freedom, 4 * std::sqrt(2 * freedom));
  EXPECT_GT(std::abs(sum - freedom - 12 * 84), 4 * std::sqrt(2 * freedom)) << "the control: p counts";
}

TEST(Planes, TellAnyFocalLengthOfUpToFiftyPictureWidths) {
  for (const double widths : {0.5, 13.0, 49.9, 50.1}) {
    const glm::dmat3 K(640 * widths, 0, 0, 0, 600 * widths, 0, 320, 240, 1);
    std::vector<glm::dmat3> homographies;
    for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(1, 2, 0.5)}) {
      glm::dmat3 view = glm::mat3_cast(glm::angleAxis(0.7, glm::normalize(axis)));
      view[2] = {0.1, -0.2, 2 * widths};
      homographies.push_back(K * view);
    }
    const auto found = IntrinsicsFromPlanes(homographies, 640, 480);
    EXPECT_EQ(found.has_value(), widths < 50) << widths;
    if (!found) continue;
    EXPECT_NEAR(found->fx, 640 * widths, 1e-6 * widths);
    EXPECT_NEAR(found->fy, 600 * widths, 1e-6 * widths);
    EXPECT_EQ(glm::dvec2(found->cx, found->cy), glm::dvec2(320, 240));
  }
}

TEST(Planes, BoardsAreLocatedThroughAnyLens) {
  const std::vector<Distortion> lenses = {
      {.k1 = -0.1, .k2 = 0.03, .p1 = 0.001, .p2 = -0.001},
      {.k1 = 0.08, .k2 = -0.02, .k3 = 0.01, .k4 = 0.006, .is_fisheye = true},
      {.k1 = 0.2, .k2 = 0.05, .p1 = 0.002, .p2 = -0.007, .k3 = 0.02, .k4 = 0.1, .k5 = -0.03, .k6 = 0.01},
      {.k1 = -0.25, .k2 = 0.06, .s1 = 0.01, .s2 = -0.006, .s3 = 0.02, .s4 = 0.004},
      {.k1 = 0.15, .tau_x = 0.06, .tau_y = -0.09}};
  for (const Distortion& lens : lenses) {
    std::vector<Camera> cameras = TrueCameras();
    for (Camera& camera : cameras) camera.distortion = lens;
    ASSERT_OK(located, LocateBoards(cameras, Views(cameras, 6, 0)));
    EXPECT_LT(located->rms_px, 1e-5) << lens.k1;
    EXPECT_EQ(located->cameras[1].distortion, lens) << "cameras are held";
  }
}

TEST(Planes, RefusedWithTheReason) {
  const std::vector<Camera> cameras = TrueCameras();
  std::vector<TargetView> views = Views(cameras, 8, 0);
  std::vector<TargetView> apart;
  for (const TargetView& view : views) {
    if ((view.camera == 2) == (view.target >= 4)) apart.push_back(view);
  }
  EXPECT_THAT(CalibrateFromPlanes(kSizes, apart).error().message,
              HasSubstr("the position of camera 3 is not determined, because this camera and the cameras before it"));
  std::vector<TargetView> without;
  for (const TargetView& view : views) {
    if (view.camera != 1) without.push_back(view);
  }
  EXPECT_THAT(CalibrateFromPlanes(kSizes, without).error().message, HasSubstr("no picture of camera 2 shows a board"));

  const Camera front;
  std::vector<TargetView> straight;
  for (std::size_t b = 0; b < 3; ++b) {
    TargetView view{0, b, {}};
    for (int i = 0; i < 35; ++i) {
      const glm::dvec3 place(0.06 * (i % 7), 0.06 * (i / 7), 0);
      view.pairs.push_back(
          {place, *Project(front, place + glm::dvec3(-0.2, -0.1, 1.0 + 0.3 * static_cast<double>(b)))});
    }
    straight.push_back(view);
  }
  EXPECT_THAT(testing::Message(CalibrateFromPlanes(std::vector<PictureSize>{{640, 480}}, straight)),
              ::testing::AnyOf(HasSubstr("tilt"), HasSubstr("do not determine")));

  std::vector<PointPair> line;
  for (int i = 0; i < 7; ++i) line.push_back({{0.1 * i, 0.2 * i, 0}, {10.0 * i, 5.0 * i}});
  EXPECT_THAT(HomographyOf(line).error().message, HasSubstr("one line"));
  EXPECT_THAT(HomographyOf(std::span(line).first(3)).error().message, HasSubstr("at least 4"));
}

}  // namespace
}  // namespace etude
