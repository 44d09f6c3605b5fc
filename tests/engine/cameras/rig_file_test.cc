#include "engine/cameras/rig_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/cameras/opencv_file.h"

namespace etude {
namespace {

using testing::HasSubstr;

std::vector<NamedCamera> TwoCameras() {
  Camera left =
      LookAt({.width = 1088, .height = 1920, .fx = 1681, .fy = 1680, .cx = 533, .cy = 948}, {1, 1.2, 3}, {0, 1, 0});
  left.distortion = {.k1 = -0.05, .k2 = 0.1, .p1 = 0.0006, .p2 = -0.0004};
  Camera right =
      LookAt({.width = 640, .height = 480, .fx = 600, .fy = 610, .cx = 321, .cy = 242}, {-2, 1.4, 2}, {0, 1, 0});
  return {{"left", left}, {"26 578: right", right}};
}

/// Two cameras show every point at the same pixel.
void ExpectSamePictures(const Camera& a, const Camera& b, double tolerance_px) {
  for (int i = 0; i < 20; ++i) {
    const glm::dvec3 point(0.3 * (i % 3) - 0.3, 0.1 * i, 0.2 * (i % 5) - 0.4);
    const auto at = Project(a, point), wanted = Project(b, point);
    ASSERT_TRUE(at && wanted);
    EXPECT_LT(glm::distance(*at, *wanted), tolerance_px);
  }
}

TEST(RigFile, ReadsWhatItWrote) {
  std::vector<NamedCamera> cameras = TwoCameras();
  const auto rig = ReadRig(WriteRig(cameras), "rig.yaml");
  cameras[1].name = "camera_26_578__right";
  ASSERT_TRUE(rig) << ToString(rig.error());
  ASSERT_EQ(rig->size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ((*rig)[i].name, cameras[i].name);
    EXPECT_EQ((*rig)[i].camera.distortion, cameras[i].camera.distortion);
    EXPECT_EQ((*rig)[i].camera.intrinsics.width, cameras[i].camera.intrinsics.width);
    ExpectSamePictures((*rig)[i].camera, cameras[i].camera, 1e-9);
  }
}

TEST(RigFile, KnowsOtherFilesByWhatIsInThem) {
  const std::vector<NamedCamera> cameras = TwoCameras();
  const auto one = ReadRig(WriteOpenCvCamera(cameras[0].camera), "camera.yaml");
  ASSERT_TRUE(one) << ToString(one.error());
  ASSERT_EQ(one->size(), 1u);
  ExpectSamePictures(one->front().camera, cameras[0].camera, 1e-9);
  const auto toml = ReadRig(WritePose2SimCalibration({cameras.data(), 1}), "Calib.toml");
  ASSERT_TRUE(toml) << ToString(toml.error());
  EXPECT_EQ(toml->front().name, "left");
  ExpectSamePictures(toml->front().camera, cameras[0].camera, 1e-6);
}

/// A camera 3 m before the world's origin and 1 m high, as QTM tells it: its z is up, pixels are in 64ths.
constexpr const char* kQualisys = R"(<?xml version="1.0" encoding="UTF-8"?>
<calibration created="2020-01-01" type="regular">
 <cameras>
  <camera active="1" avg-residual="0.5" serial="26578" model="Miqus Video" viewrotation="0">
   <fov_video left="40" top="0" right="1879" bottom="1079"/>
   <transform x="3000" y="0" z="1000" r11="0" r12="1" r13="0" r21="0" r22="0" r23="1" r31="1" r32="0" r33="0"/>
   <intrinsic focallength="9.2" sensorMinU="0" sensorMaxU="122880" sensorMinV="0" sensorMaxV="69632"
     focalLengthU="107520" focalLengthV="106880" centerPointU="60800" centerPointV="32640" skew="0"
     radialDistortion1="-0.045" radialDistortion2="0.14" radialDistortion3="0"
     tangentalDistortion1="0.0006" tangentalDistortion2="-0.0004"/>
  </camera>
 </cameras>
</calibration>)";

TEST(RigFile, ReadsQualisys) {
  const auto rig = ReadRig(kQualisys, "session.qca.txt");
  ASSERT_TRUE(rig) << ToString(rig.error());
  ASSERT_EQ(rig->size(), 1u);
  EXPECT_EQ(rig->front().name, "26578");
  const Camera& camera = rig->front().camera;
  EXPECT_EQ(camera.intrinsics.width, 1840);
  EXPECT_EQ(camera.intrinsics.height, 1080);
  EXPECT_DOUBLE_EQ(camera.intrinsics.fx, 1680);
  EXPECT_DOUBLE_EQ(camera.intrinsics.fy, 1670);
  EXPECT_DOUBLE_EQ(camera.intrinsics.cx, 950 - 40 + 0.5);
  EXPECT_DOUBLE_EQ(camera.intrinsics.cy, 510.5);
  EXPECT_DOUBLE_EQ(camera.distortion.k1, -0.045) << "not in 64ths";
  EXPECT_DOUBLE_EQ(camera.distortion.p2, -0.0004);
  // QTM's x is our z, its y our x: from 3 m before, looking back at the origin, what is left of it (our −x) is left.
  EXPECT_LT(glm::distance(camera.p_WC, glm::dvec3(0, 1, 3)), 1e-12);
  const auto middle = Project(camera, {0, 1, 0}), left = Project(camera, {-0.5, 1, 0}),
             above = Project(camera, {0, 1.5, 0});
  ASSERT_TRUE(middle && left && above);
  EXPECT_LT(glm::distance(*middle, glm::dvec2(camera.intrinsics.cx, camera.intrinsics.cy)), 1e-9);
  EXPECT_LT(left->x, middle->x);
  EXPECT_LT(above->y, middle->y);
}

std::string Changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(RigFile, RefusedWithPlaceAndReason) {
  const auto reason = [](const std::string& text) {
    const auto rig = ReadRig(text, "rig");
    return rig ? std::string("no complaint") : ToString(rig.error());
  };
  std::vector<NamedCamera> cameras = TwoCameras();
  cameras[1].name = "right";
  const std::string good = WriteRig(cameras);
  EXPECT_EQ(reason(good), "no complaint");
  EXPECT_THAT(reason(""), HasSubstr("nothing in it"));
  EXPECT_THAT(reason("hello"), HasSubstr("no calibration; allowed: a rig of etude calibrate"));
  EXPECT_THAT(reason(Changed(good, "\nright:", "\nwrong:")), HasSubstr("right is listed, and not told of"));
  EXPECT_THAT(reason(Changed(good, "\"right\"", "\"left\"")), HasSubstr("two cameras of the name left"));
  EXPECT_THAT(reason(Changed(good, "image_width: 1088", "image_width: -3")), HasSubstr("-3 x 1920 pixels"));
  EXPECT_THAT(reason(Changed(good, "   T:", "   S:")), HasSubstr("camera left: no T"));
  EXPECT_THAT(reason(kQualisys), "no complaint");
  EXPECT_EQ(reason(Changed(kQualisys, "viewrotation=\"0\"", "viewrotation=\"90\"")), "no complaint");
  EXPECT_THAT(reason("%YAML:1.0\n---\nnames:\n  - \"1\"\n"), HasSubstr("intri.yml and extri.yml"));
  EXPECT_THAT(reason(Changed(kQualisys, "x=\"3000\"", "x=\"3m\"")), HasSubstr("rig:6: x=\"3m\" is no number"));
  EXPECT_THAT(reason(Changed(kQualisys, "r11=\"0\"", "r11=\"5\"")), HasSubstr("R is no rotation"));
  EXPECT_THAT(reason(Changed(kQualisys, "</cameras>", "")), HasSubstr("no XML"));
  EXPECT_THAT(reason("<html/>"), HasSubstr("allowed: <calibration>"));
  EXPECT_THAT(reason(std::string(2u << 20, ' ')), HasSubstr("allowed: 1048576"));
}

}  // namespace
}  // namespace etude
