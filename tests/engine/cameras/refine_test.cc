#include "engine/cameras/refine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/random/stream.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

Camera TrueCamera() {
  Intrinsics in{.width = 640, .height = 480, .fx = 610, .fy = 590, .cx = 327, .cy = 231, .skew = 0};
  Camera camera = LookAt(in, {2.2, 1.4, 3.1}, {0, 1, 0});
  camera.distortion = {.k1 = -0.12, .k2 = 0.05, .p1 = 0.001, .p2 = -0.002};
  return camera;
}

RandomStream Dice(int seed, const char* purpose) {
  return RandomStream(WorldKey{.suite_seed = 1, .scenario = "refine", .trial = seed}, purpose);
}

/// Returns random points in a box of 2 m with their pixels. Both coordinates of each pixel have a normal error of
/// standard deviation `sigma_px`.
std::vector<PointPair> Pairs(const Camera& camera, int count, int seed, double sigma_px) {
  RandomStream places = Dice(seed, "places"), errors = Dice(seed, "errors");
  std::vector<PointPair> pairs;
  while (static_cast<int>(pairs.size()) < count) {
    const glm::dvec3 world(places.Uniform(-1, 1), places.Uniform(0, 2), places.Uniform(-1, 1));
    const auto pixel = Project(camera, world);
    if (pixel) pairs.push_back({world, *pixel + sigma_px * glm::dvec2(errors.Normal(), errors.Normal())});
  }
  return pairs;
}

void ExpectSame(const Camera& found, const Camera& wanted, double tolerance) {
  const Intrinsics &a = found.intrinsics, &b = wanted.intrinsics;
  EXPECT_NEAR(a.fx, b.fx, tolerance * b.fx);
  EXPECT_NEAR(a.fy, b.fy, tolerance * b.fy);
  EXPECT_NEAR(a.cx, b.cx, tolerance * b.cx);
  EXPECT_NEAR(a.cy, b.cy, tolerance * b.cy);
  EXPECT_NEAR(a.skew, b.skew, tolerance * b.fx);
  const Distortion &c = found.distortion, &d = wanted.distortion;
  for (const auto& [x, y] : {std::pair(c.k1, d.k1), {c.k2, d.k2}, {c.p1, d.p1}, {c.p2, d.p2}, {c.k3, d.k3}}) {
    EXPECT_NEAR(x, y, tolerance);
  }
  EXPECT_LT(glm::distance(found.p_WC, wanted.p_WC), tolerance);
  for (int i = 0; i < 3; ++i) EXPECT_LT(glm::distance(found.R_CW[i], wanted.R_CW[i]), tolerance);
}

TEST(RefineCamera, GivesEveryParameterBackFromExactPairs) {
  ASSERT_OK(rig, RefineCamera(Pairs(TrueCamera(), 40, 1, 0), 640, 480));
  ExpectSame(rig->cameras[0], TrueCamera(), 1e-9);
  EXPECT_LT(rig->rms_px, 1e-9);
  EXPECT_EQ(rig->parameters, 14u);
  EXPECT_EQ(rig->points, 40u);
}

TEST(RefineCamera, FindsTheElevenDegreesOfFreedomOfThePaper) {
  Camera camera = TrueCamera();
  camera.distortion = {};
  camera.intrinsics.skew = 4;
  ASSERT_OK(rig, RefineCamera(Pairs(camera, 12, 2, 0), 640, 480, {.lens = LensModel::kPinhole, .skew = true}));
  ExpectSame(rig->cameras[0], camera, 1e-9);
  EXPECT_EQ(rig->parameters, 11u);
}

TEST(RefineCamera, FindsTheSixthPowerOfAWideLens) {
  Camera camera = TrueCamera();
  camera.distortion.k3 = 0.03;
  ASSERT_OK(rig, RefineCamera(Pairs(camera, 80, 3, 0), 640, 480, {.lens = LensModel::kRadial3}));
  ExpectSame(rig->cameras[0], camera, 1e-9);
  ASSERT_OK(without, RefineCamera(Pairs(camera, 80, 3, 0), 640, 480));
  EXPECT_GT(without->rms_px, 1e-4) << "the control: a model that lacks it leaves a residual";
}

/// Σ r² / σ² is χ² with 2N − p degrees of freedom, so a coordinate's residual is σ √((2N − p) / 2N). The mean over many
/// draws must agree within four standard errors.
TEST(RefineCamera, LeavesTheResidualThatNoiseShouldLeave) {
  constexpr int kSeeds = 300, kPoints = 40;
  constexpr double kSigma = 0.5;
  double sum = 0;
  std::size_t parameters = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const auto rig = RefineCamera(Pairs(TrueCamera(), kPoints, 100 + seed, kSigma), 640, 480);
    ASSERT_TRUE(rig) << seed << ": " << ToString(rig.error());
    sum += rig->rms_px * rig->rms_px * kPoints / (kSigma * kSigma);
    parameters = rig->parameters;
  }
  const double freedom = 2.0 * kPoints - static_cast<double>(parameters);
  const double tolerance = 4 * std::sqrt(2 * freedom / kSeeds);
  EXPECT_NEAR(sum / kSeeds, freedom, tolerance);
  EXPECT_GT(std::abs(sum / kSeeds - 2.0 * kPoints), tolerance) << "the control: not σ itself";
  EXPECT_GT(std::abs(sum / kSeeds - (2.0 * kPoints - 10)), tolerance) << "the control: not another p";
}

/// The estimates scatter about the truth by the fit's reported deviations.
TEST(RefineCamera, TellsHowUncertainItsFocalLengthIs) {
  constexpr int kSeeds = 200;
  double squares = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    ASSERT_OK(rig, RefineCamera(Pairs(TrueCamera(), 40, 500 + seed, 0.5), 640, 480));
    const double off = (rig->cameras[0].intrinsics.fx - TrueCamera().intrinsics.fx) / rig->deviations[0].fx;
    squares += off * off;
  }
  // Student's t with 66 degrees of freedom has variance 1.03; ±4 standard errors of the mean square of 200 values.
  EXPECT_NEAR(squares / kSeeds, 1.03, 4 * std::sqrt(2.1 / kSeeds));
}

TEST(RefineCamera, RefusesWhatDoesNotDetermineACamera) {
  const auto reason = [](std::span<const PointPair> pairs) { return testing::Message(RefineCamera(pairs, 640, 480)); };
  const std::vector<PointPair> good = Pairs(TrueCamera(), 40, 4, 0);
  EXPECT_EQ(reason(good), "accepted") << "the control";
  EXPECT_THAT(reason(std::span(good).first(5)), HasSubstr("at least 6"));
  EXPECT_THAT(reason(std::span(good).first(6)), HasSubstr("12 equations, but there are 14 unknowns"));
  std::vector<PointPair> plane = good, line = good, broken = good, swapped = good;
  for (PointPair& pair : plane) pair = {{pair.world.x, pair.world.y, 0}, pair.pixel};
  EXPECT_THAT(reason(plane), HasSubstr("one plane"));
  for (PointPair& pair : line) pair = {{pair.world.x, 2 * pair.world.x, 0}, pair.pixel};
  EXPECT_THAT(reason(line), HasSubstr("one line"));
  broken[7].pixel.y = std::numeric_limits<double>::infinity();
  EXPECT_THAT(reason(broken), HasSubstr("point pair 8 has a coordinate that is not finite"));
}

TEST(RefineRig, RefusesViewsThatLeaveTheFocalLengthOpen) {
  // A board seen straight on may be near and small or far and large.
  std::vector<PointPair> board;
  Camera camera;
  for (int i = 0; i < 25; ++i) board.push_back({{0.1 * (i % 5), 0.1 * (i / 5), 0}, {}});
  const CalibrationTargetPose pose{glm::dmat3(1), {-0.2, -0.2, 2}};
  for (PointPair& pair : board) pair.pixel = *Project(camera, pair.world + pose.p_WT);
  EXPECT_THAT(testing::Message(RefineRig({{camera}, {CalibrationTargetPose{glm::dmat3(1), pose.p_WT}}},
                                         std::vector<TargetView>{{0, 0, board}}, {.lens = LensModel::kPinhole})),
              HasSubstr("do not determine"));
}

TEST(RefineRig, HoldsWhatIsKnownInsideACamera) {
  Camera off = TrueCamera();
  off.p_WC += glm::dvec3(0.1, -0.05, 0.2);
  const std::vector<TargetView> views{{0, 0, Pairs(TrueCamera(), 10, 5, 0)}};
  const auto rig =
      RefineRig({{off}, {CalibrationTargetPose{}}}, views, {.lens = LensModel::kAsInCamera, .hold_intrinsics = true});
  ASSERT_TRUE(rig) << ToString(rig.error());
  EXPECT_EQ(rig->parameters, 6u);
  ExpectSame(rig->cameras[0], TrueCamera(), 1e-9);
}

TEST(RefineRig, SaysWhatIsWrongWithViews) {
  const std::vector<PointPair> pairs = Pairs(TrueCamera(), 20, 6, 0.3), two(pairs.begin(), pairs.begin() + 2);
  const RigGuess guess{{TrueCamera(), TrueCamera()}, {CalibrationTargetPose{}, CalibrationTargetPose{}}};
  const auto reason = [&](const std::vector<TargetView>& views, const RefineOptions& options = {}) {
    return testing::Message(RefineRig(guess, views, options));
  };
  EXPECT_EQ(reason({{0, 0, pairs}, {1, 1, pairs}, {0, 1, pairs}}), "accepted");
  EXPECT_EQ(reason({{0, 0, pairs}, {2, 0, pairs}}), "a view refers to a camera or a board that does not exist");
  EXPECT_EQ(reason({{0, 0, pairs}, {1, 2, pairs}}), "a view refers to a camera or a board that does not exist");
  EXPECT_EQ(reason({{0, 0, pairs}, {0, 1, pairs}}), "camera 2 has no point");
  EXPECT_EQ(reason({{0, 0, pairs}, {1, 0, pairs}, {1, 1, two}}), "the views do not determine the position of board 2");
  EXPECT_EQ(reason({{0, 0, two}, {1, 1, two}}),
            "4 points give 8 equations, but there are 34 unknowns; more points are needed");
  EXPECT_EQ(reason({{0, 0, two}, {1, 1, two}}, {.hold_intrinsics = true}),
            "4 points give 8 equations, but there are 18 unknowns; more points are needed");
  std::vector<PointPair> broken = pairs;
  broken[3].world.z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(reason({{0, 0, pairs}, {1, 1, broken}}), "camera 2: a point pair has a coordinate that is not finite");
  broken[3].world = TrueCamera().p_WC + glm::dvec3(5, 0, 5);
  EXPECT_EQ(reason({{0, 0, broken}, {1, 0, pairs}, {1, 1, pairs}}),
            "in the first estimate, a point is behind the camera that saw it; are the world points paired with the "
            "right pixels?");
}

}  // namespace
}  // namespace etude
