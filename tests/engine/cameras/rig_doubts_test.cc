#include "engine/cameras/rig_doubts.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr Intrinsics kInside{.width = 1280, .height = 720, .fx = 900, .fy = 900, .cx = 640, .cy = 360};

/// Returns cameras on a circle of 4 m around a person, at these angles.
std::vector<NamedCamera> Around(std::span<const double> angles_deg, double metres = 1) {
  std::vector<NamedCamera> cameras;
  for (const double angle : angles_deg) {
    const glm::dvec3 p_WC(4 * std::sin(Radians(angle)), 1.5, 4 * std::cos(Radians(angle)));
    cameras.push_back({"cam" + std::to_string(cameras.size() + 1), LookAt(kInside, metres * p_WC, {0, metres, 0})});
  }
  return cameras;
}

/// Turns a camera about its vertical axis by 180°.
void LookAway(Camera& camera) { camera.R_CW = glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, -1) * camera.R_CW; }

TEST(RigDoubts, HasNoneAboutCamerasThatSeeOnePlace) {
  using Angles = std::vector<double>;
  for (const Angles& angles : {Angles{0, 180}, {0, 3}, {0, 90, 180, 270}, {-40, 40, 160}, {10}}) {
    for (const double metres : {0.001, 1.0, 1000.0}) EXPECT_THAT(RigDoubts(Around(angles, metres)), IsEmpty());
  }
  // Telephoto lenses, parallel axes, two cameras at one place, and cameras in a row that see only their neighbours.
  std::vector<NamedCamera> tele = Around(std::vector{0.0, 120.0, 240.0});
  for (NamedCamera& named : tele) named.camera.intrinsics.fx = named.camera.intrinsics.fy = 20'000;
  EXPECT_THAT(RigDoubts(tele), IsEmpty());
  std::vector<NamedCamera> stereo = Around(std::vector{0.0, 0.0});
  EXPECT_THAT(RigDoubts(stereo), IsEmpty());
  stereo[1].camera.p_WC.x += 0.1;
  EXPECT_THAT(RigDoubts(stereo), IsEmpty());
  std::vector<NamedCamera> row;
  for (const double x : {0.0, 3.0, 6.0, 9.0}) {
    row.push_back({"r" + std::to_string(row.size()), LookAt(kInside, {x, 1, 4}, {x, 1, 0})});
  }
  EXPECT_THAT(RigDoubts(row), IsEmpty());
}

TEST(RigDoubts, NamesCamerasThatLookAway) {
  std::vector<NamedCamera> cameras = Around(std::vector{0.0, 20.0, -20.0});
  LookAway(cameras[2].camera);
  EXPECT_THAT(RigDoubts(cameras), ElementsAre(StartsWith("cam3: the field of view of this camera does not overlap")));
  for (const std::vector<double>& angles : {std::vector{0.0, 180.0}, {0.0, 120.0, 240.0}, {0.0, 90.0, 180.0, 270.0}}) {
    cameras = Around(angles);
    for (NamedCamera& named : cameras) LookAway(named.camera);
    EXPECT_EQ(RigDoubts(cameras).size(), angles.size());
  }
  // A picture of unknown size is not judged.
  for (NamedCamera& named : cameras) named.camera.intrinsics.width = named.camera.intrinsics.height = 0;
  EXPECT_THAT(RigDoubts(cameras), IsEmpty());
}

// A camera that was calibrated at 640 x 360 or 1920 x 1080, in a rig whose pictures have 1280 x 720.
TEST(RigDoubts, NamesAPrincipalPointInTheMiddleOfAnotherPicture) {
  for (const double scale : {0.5, 2 / 3.0, 1.5}) {
    std::vector<NamedCamera> cameras = Around(std::vector{0.0, 30.0});
    Intrinsics& in = cameras[0].camera.intrinsics;
    for (double* value : {&in.fx, &in.fy, &in.cx, &in.cy}) *value *= scale;
    EXPECT_THAT(RigDoubts(cameras), ElementsAre(StartsWith("cam1: the principal point (")));
    EXPECT_THAT(RigDoubts(cameras)[0],
                HasSubstr(fmt::format("the middle of a picture of {:.0f} x {:.0f} pixels, not of 1280 x 720; was",
                                      1280 * scale, 720 * scale)));
    // The control: an axis that is a little off, or off in one direction only.
    in = kInside;
    in.cx += 100;
    in.cy -= 60;
    EXPECT_THAT(RigDoubts(cameras), IsEmpty());
    in.cx += 200;
    EXPECT_THAT(RigDoubts(cameras), IsEmpty());
  }
}

TEST(RigDoubts, NamesAPrincipalPointOutsideOfThePicture) {
  std::vector<NamedCamera> cameras = Around(std::vector{0.0, 30.0});
  cameras[1].camera.intrinsics.cx = 1400;
  EXPECT_THAT(RigDoubts(cameras),
              ElementsAre(StartsWith("cam2: the principal point (1400, 360) is outside the picture of 1280 x 720")));
  cameras[1].camera.intrinsics.cx = -1;
  EXPECT_EQ(RigDoubts(cameras).size(), 1u);
  cameras[1].camera.intrinsics.cx = 1;
  EXPECT_THAT(RigDoubts(cameras), IsEmpty());
}

}  // namespace
}  // namespace etude
