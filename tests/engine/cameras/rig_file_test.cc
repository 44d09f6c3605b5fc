#include "engine/cameras/rig_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "engine/cameras/opencv_file.h"
#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

std::vector<NamedCamera> TwoCameras() {
  Camera left =
      LookAt({.width = 1088, .height = 1920, .fx = 1681, .fy = 1680, .cx = 533, .cy = 948}, {1, 1.2, 3}, {0, 1, 0});
  left.distortion = {.k1 = -0.05, .k2 = 0.1, .p1 = 0.0006, .p2 = -0.0004};
  Camera right =
      LookAt({.width = 640, .height = 480, .fx = 600, .fy = 610, .cx = 321, .cy = 242}, {-2, 1.4, 2}, {0, 1, 0});
  return {{"left", left}, {"26 578: right", right}};
}

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
  ASSERT_OK(one, ReadRig(WriteOpenCvCamera(cameras[0].camera), "camera.yaml"));
  ASSERT_EQ(one->size(), 1u);
  ExpectSamePictures(one->front().camera, cameras[0].camera, 1e-9);
  ASSERT_OK(toml, ReadRig(WritePose2SimCalibration({cameras.data(), 1}), "Calib.toml"));
  EXPECT_EQ(toml->front().name, "left");
  ExpectSamePictures(toml->front().camera, cameras[0].camera, 1e-6);
}

/// A camera 3 m in front of the world's origin and 1 m high, in QTM's format: z up, pixels in 64ths.
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
  ASSERT_OK(rig, ReadRig(kQualisys, "session.qca.txt"));
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
  // QTM's x is our z, its y our x. The camera is 3 m in front and looks back, so what is left (−x) stays left.
  EXPECT_LT(glm::distance(camera.p_WC, glm::dvec3(0, 1, 3)), 1e-12);
  const auto middle = Project(camera, {0, 1, 0}), left = Project(camera, {-0.5, 1, 0}),
             above = Project(camera, {0, 1.5, 0});
  ASSERT_TRUE(middle && left && above);
  EXPECT_LT(glm::distance(*middle, glm::dvec2(camera.intrinsics.cx, camera.intrinsics.cy)), 1e-9);
  EXPECT_LT(left->x, middle->x);
  EXPECT_LT(above->y, middle->y);
}

TEST(RigFile, RefusedWithPlaceAndReason) {
  const auto reason = [](const std::string& text) { return testing::Refusal(ReadRig(text, "rig")); };
  std::vector<NamedCamera> cameras = TwoCameras();
  cameras[1].name = "right";
  const std::string good = WriteRig(cameras);
  EXPECT_EQ(reason(good), "accepted");
  EXPECT_THAT(reason("hello"),
              HasSubstr("this is not a calibration; allowed: a rig file written by `etude calibrate`"));
  // TOML with a camera is a calibration, also in one line.
  EXPECT_THAT(reason("var rig = {\"a\": 1};"), HasSubstr("this is not a calibration"));
  EXPECT_THAT(reason("left={matrix=[[1, 0], [0, 1]]}\n"), HasSubstr("camera left"));
  EXPECT_THAT(reason("a = 1\n"), HasSubstr("this is not a calibration"));
  EXPECT_THAT(reason(testing::Replaced(good, "\"right\"", "\"left\"")), HasSubstr("two cameras are named left"));
  EXPECT_THAT(reason(testing::Replaced(good, "   T:", "   S:")), HasSubstr("camera left: no T"));
  EXPECT_EQ(reason(testing::Replaced(kQualisys, "viewrotation=\"0\"", "viewrotation=\"90\"")), "accepted");
  EXPECT_THAT(reason("%YAML:1.0\n---\nnames:\n  - \"1\"\n"), HasSubstr("intri.yml and extri.yml"));
  EXPECT_THAT(reason("<html/>"), HasSubstr("allowed: <calibration>"));
}

TEST(RigFile, RefusesWhateverNumberIsNotFinite) {
  // Replaces every number of every camera in turn; the unchanged control is read.
  const auto spoilt = [](const std::string& good, const std::string& nan, std::string_view begins) {
    EXPECT_TRUE(ReadRig(good, "rig"));
    int read = 0, refused = 0;
    for (std::size_t at = good.find(begins); at < good.size(); at = good.find_first_of("0123456789", at)) {
      const std::size_t from = at = good.find_first_of("0123456789", at);
      if (from == std::string::npos) break;
      at = good.find_first_not_of("0123456789.e-+", from);
      const char before = good[from - 1];
      if (before != ' ' && before != '-' && before != '[') continue;  // part of a name
      const std::string bad = good.substr(0, from) + nan + good.substr(std::min(at, good.size()));
      const auto rig = ReadRig(bad, "rig");
      EXPECT_FALSE(rig) << bad.substr(from < 60 ? 0 : from - 60, 90);
      (rig ? read : refused) += 1;
    }
    EXPECT_EQ(read, 0);
    EXPECT_GT(refused, 20);
  };
  const NamedCamera camera{"left", TwoCameras().front().camera};
  std::string toml = WritePose2SimCalibration(std::span(&camera, 1));
  toml.resize(toml.find("[metadata]"));
  spoilt(toml, "nan", "size");
  spoilt(toml, "inf", "size");
  std::string yaml = WriteOpenCvCamera(camera.camera);
  for (std::size_t at = 0; (at = yaml.find("   rows:", at)) != std::string::npos;) {
    yaml.erase(at, yaml.find("   data:", at) - at);  // matrix sizes are not read
  }
  spoilt(yaml, "nan", "image_width");
  spoilt(yaml, ".nan", "image_width");
}

// A mirrored camera has a matrix of orthogonal rows, but the determinant -1.
TEST(RigFile, RefusesAMirroredCameraInEveryFormatWithAMatrix) {
  const std::string said =
      "R is not a rotation matrix; it is a reflection, with the determinant -1; allowed: the determinant 1";
  Camera mirrored = TwoCameras().front().camera;
  mirrored.R_CW = glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1) * mirrored.R_CW;
  EXPECT_EQ(testing::Message(CameraOf(ParametersOf(mirrored))), said);
  EXPECT_THAT(testing::Refusal(ReadRig(WriteOpenCvCamera(mirrored), "rig")), HasSubstr(said));
  const std::string toml =
      "[a]\nsize = [640, 480]\nmatrix = [[600, 0, 320], [0, 600, 240], [0, 0, 1]]\ndistortions = [0, 0, 0, 0]\n"
      "rotation = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\ntranslation = [0, 0, 4]\n";
  EXPECT_TRUE(ReadRig(toml, "rig"));
  std::string keys = toml.substr(4, toml.size() - 5);
  std::ranges::replace(keys, '\n', ',');
  EXPECT_TRUE(ReadRig("a = {" + keys + "}\n", "rig")) << "a table in one line";
  EXPECT_THAT(testing::Refusal(ReadRig("a = {" + testing::Replaced(keys, "[0, 0, 4]", "[0, 0]") + "}\n", "rig")),
              HasSubstr("camera a: translation has 2 numbers"));
  EXPECT_THAT(testing::Refusal(
                  ReadRig(testing::Replaced(toml, "[0, 1, 0], [0, 0, 1]]\nt", "[0, -1, 0], [0, 0, 1]]\nt"), "rig")),
              HasSubstr(said));
  const std::string qualisys = testing::Replaced(kQualisys, "r12=\"1", "r12=\"-1");
  EXPECT_THAT(testing::Refusal(ReadRig(qualisys, "rig")), HasSubstr("R is not a rotation matrix"));
}

TEST(RigFile, RefusesALensThatItCannotRead) {
  const std::string toml = WritePose2SimCalibration(TwoCameras());
  EXPECT_THAT(testing::Message(ReadRig(testing::Replaced(toml, "fisheye = false", "fisheye = 'yes'"), "rig")),
              HasSubstr("'fisheye' must be true or false"));
}

std::string OpenCvMatrix(const std::string& name, std::size_t rows, const std::vector<double>& values) {
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {:.17g} ]\n", name, rows,
                     values.size() / rows, fmt::join(values, ", "));
}

/// X_C = R X_F + T in a file's axes with Z up; its (x, y, z) is our (y, z, x).
struct FilePose {
  glm::dmat3 R;
  glm::dvec3 T;

  explicit FilePose(const Camera& camera)
      : R(camera.R_CW * glm::dmat3(0, 0, 1, 1, 0, 0, 0, 1, 0)), T(-(camera.R_CW * camera.p_WC)) {}
  std::vector<double> Rows() const {
    return {R[0][0], R[1][0], R[2][0], R[0][1], R[1][1], R[2][1], R[0][2], R[1][2], R[2][2]};
  }
};

std::vector<double> OpenCvIntrinsics(const Intrinsics& in) {
  return {in.fx, 0, in.cx - 0.5, 0, in.fy, in.cy - 0.5, 0, 0, 1};
}

constexpr const char* kYaml = "%YAML:1.0\n---\n";

TEST(RigPair, ReadsEasyMocapsFiles) {
  for (const bool is_vector : {false, true}) {  // rotation vectors, then matrices
    for (const bool has_size : {false, true}) {
      const std::vector<NamedCamera> cameras = TwoCameras();
      std::string inside = std::string(kYaml) + "names:\n  - \"a\"\n  - \"b\"\n", outside = kYaml;
      for (std::size_t i = 0; i < 2; ++i) {
        const std::string name = i == 0 ? "a" : "b";
        const Camera& camera = cameras[i].camera;
        const FilePose pose(camera);
        const Distortion& d = camera.distortion;
        inside += OpenCvMatrix("K_" + name, 3, OpenCvIntrinsics(camera.intrinsics));
        inside += OpenCvMatrix("dist_" + name, 1, {d.k1, d.k2, d.p1, d.p2, 0});
        if (has_size) {
          inside += fmt::format("H_{0}: {1}\nW_{0}: {2}\n", name, camera.intrinsics.height, camera.intrinsics.width);
        }
        const glm::dquat q = glm::quat_cast(pose.R);
        const glm::dvec3 turn = glm::angle(q) * glm::axis(q);
        outside += is_vector ? OpenCvMatrix("R_" + name, 3, {turn.x, turn.y, turn.z})
                             : OpenCvMatrix("Rot_" + name, 3, pose.Rows());
        outside += OpenCvMatrix("T_" + name, 3, {pose.T.x, pose.T.y, pose.T.z});
      }
      ASSERT_OK(rig, ReadRigPair(inside, outside, "intri.yml", "extri.yml"));
      EXPECT_EQ(rig->format, "EasyMocap");
      EXPECT_TRUE(rig->has_unit);
      ASSERT_EQ(rig->cameras.size(), 2u);
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(rig->cameras[i].name, i == 0 ? "a" : "b");
        EXPECT_EQ(rig->cameras[i].camera.intrinsics.width, has_size ? cameras[i].camera.intrinsics.width : 0);
        EXPECT_EQ(rig->cameras[i].camera.intrinsics.height, has_size ? cameras[i].camera.intrinsics.height : 0);
        ExpectSamePictures(rig->cameras[i].camera, cameras[i].camera, 1e-6);
      }
      EXPECT_THAT(
          ToString(ReadRigPair(testing::Replaced(inside, "K_b:", "L_b:"), outside, "intri.yml", "extri.yml").error()),
          HasSubstr("no K_b"));
    }
  }
}

// EasyMocap writes six decimals, and wrote three; Qualisys writes six.
TEST(RigFile, RotationMatricesMayBeRounded) {
  for (const auto& [decimals, most_px] : {std::pair(3, 1.5), {4, 0.15}, {5, 0.015}, {6, 0.0015}}) {
    for (int turn = 0; turn < 20; ++turn) {
      Camera camera = TwoCameras().front().camera;
      camera.R_CW =
          camera.R_CW * glm::dmat3(glm::mat3_cast(glm::angleAxis(0.3 * turn, glm::normalize(glm::dvec3(1, 2, turn)))));
      const double scale = std::pow(10.0, decimals);
      OpenCvParameters rounded = ParametersOf(camera);
      for (int i = 0; i < 3; ++i) rounded.R[i] = glm::round(rounded.R[i] * scale) / scale;
      ASSERT_OK(read, CameraOf(rounded));
      EXPECT_LT(glm::length((read->R_CW - camera.R_CW)[2]) * camera.intrinsics.fx, most_px);
      const glm::dmat3 off = read->R_CW * glm::transpose(read->R_CW) - glm::dmat3(1);
      for (int i = 0; i < 9; ++i) EXPECT_LT(std::abs(off[i / 3][i % 3]), 1e-6);
    }
  }
}

TEST(RigPair, ReadsOpenCvsStereoWhoseWorldIsTheLeftCamera) {
  const std::vector<NamedCamera> cameras = TwoCameras();
  const Camera &left = cameras[0].camera, &right = cameras[1].camera;
  const glm::dmat3 R = right.R_CW * glm::transpose(left.R_CW);
  const glm::dvec3 T = right.R_CW * (left.p_WC - right.p_WC);
  const Distortion& d = left.distortion;
  const std::string inside = kYaml + OpenCvMatrix("M1", 3, OpenCvIntrinsics(left.intrinsics)) +
                             OpenCvMatrix("D1", 1, {d.k1, d.k2, d.p1, d.p2, 0}) +
                             OpenCvMatrix("M2", 3, OpenCvIntrinsics(right.intrinsics)) +
                             OpenCvMatrix("D2", 1, {0, 0, 0, 0, 0});
  const std::string outside =
      kYaml + OpenCvMatrix("R", 3, {R[0][0], R[1][0], R[2][0], R[0][1], R[1][1], R[2][1], R[0][2], R[1][2], R[2][2]}) +
      OpenCvMatrix("T", 3, {T.x, T.y, T.z});
  ASSERT_OK(rig, ReadRigPair(inside, outside, "intrinsics.yml", "extrinsics.yml"));
  EXPECT_EQ(rig->format, "OpenCV stereo");
  ASSERT_EQ(rig->cameras.size(), 2u);
  EXPECT_EQ(rig->cameras[0].name, "left");
  EXPECT_EQ(rig->cameras[1].name, "right");
  for (int i = 0; i < 20; ++i) {
    const glm::dvec3 point(0.3 * (i % 3) - 0.3, 0.1 * i, 0.2 * (i % 5) - 0.4);
    const glm::dvec3 in_left = left.R_CW * (point - left.p_WC);
    const glm::dvec3 ours(in_left.y, in_left.z, in_left.x);  // the axes of files with Z up
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_LT(glm::distance(*Project(rig->cameras[c].camera, ours), *Project(cameras[c].camera, point)), 1e-6) << c;
    }
  }
}

TEST(RigPair, ReadsColmapsModels) {
  const Camera truth = TwoCameras()[0].camera;
  const FilePose pose(truth);
  const glm::dquat q = glm::quat_cast(pose.R);
  const std::string image =
      fmt::format("# a comment\n7 {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} 3 films/left.0.png\n", q.w,
                  q.x, q.y, q.z, pose.T.x, pose.T.y, pose.T.z);
  struct Model {
    std::string line;
    double fy = 1680;
    Distortion distortion = {};
  };
  for (const Model& model :
       {Model{"PINHOLE 1088 1920 1681 1680 533 948"},
        {"SIMPLE_PINHOLE 1088 1920 1681 533 948", 1681},
        {"SIMPLE_RADIAL 1088 1920 1681 533 948 -0.05", 1681, {.k1 = -0.05}},
        {"RADIAL 1088 1920 1681 533 948 -0.05 0.1", 1681, {.k1 = -0.05, .k2 = 0.1}},
        {"OPENCV 1088 1920 1681 1680 533 948 -0.05 0.1 0.0006 -0.0004", 1680, truth.distortion},
        {"FULL_OPENCV 1088 1920 1681 1680 533 948 -0.05 0.1 0.0006 -0.0004 0.01 0.02 0.03 0.04",
         1680,
         {.k1 = -0.05, .k2 = 0.1, .p1 = 0.0006, .p2 = -0.0004, .k3 = 0.01, .k4 = 0.02, .k5 = 0.03, .k6 = 0.04}},
        {"RADIAL_FISHEYE 1088 1920 1681 533 948 -0.05 0.01", 1681, {.k1 = -0.05, .k2 = 0.01, .is_fisheye = true}}}) {
    const auto rig = ReadRigPair("3 " + model.line + "\n", image, "cameras.txt", "images.txt");
    ASSERT_TRUE(rig) << model.line << ToString(rig.error());
    EXPECT_EQ(rig->format, "COLMAP");
    EXPECT_FALSE(rig->has_unit);
    ASSERT_EQ(rig->cameras.size(), 1u);
    EXPECT_EQ(rig->cameras[0].name, "left.0");
    const Camera& camera = rig->cameras[0].camera;
    EXPECT_EQ(camera.intrinsics.width, 1088);
    EXPECT_EQ(camera.intrinsics.height, 1920);
    Camera expected = truth;
    expected.intrinsics.fy = model.fy;
    expected.distortion = model.distortion;
    EXPECT_EQ(camera.distortion, model.distortion) << model.line;
    ExpectSamePictures(camera, expected, 1e-6);
  }
}

TEST(RigPair, OfColmapIsRefusedWithLineAndReason) {
  const auto reason = [](const std::string& cameras, const std::string& images) {
    const auto rig = ReadRigPair(cameras, images, "cameras.txt", "images.txt");
    return rig ? fmt::format("{} cameras", rig->cameras.size()) : ToString(rig.error());
  };
  const std::string camera = "1 PINHOLE 640 480 600 600 320 240\n", image = "1 1 0 0 0 0 0 3 1 a.png\n";
  EXPECT_EQ(reason(camera, image + "12 34 -1\n" + "2 1 0 0 0 0 0 4 1 b.png\n\n"), "2 cameras");
  EXPECT_THAT(reason("\n1 PIN 640 480 600\n", image), HasSubstr("2: camera model PIN; allowed: FULL_OPENCV, OPENCV"));
  EXPECT_THAT(reason("1 PINHOLE 640 480 600 6oo 320 240\n", image), HasSubstr("'6oo' is not a number"));
  EXPECT_THAT(reason(camera, "1 1 0 0 0 0 0 3 1\n"),
              HasSubstr("this line does not describe an image; allowed: IMAGE_ID"));
  EXPECT_THAT(reason(camera, "1 1 0 0 0 0 0 3 2 a.png\n"), HasSubstr("camera 2 is not in cameras.txt"));
  EXPECT_THAT(reason(camera, "# none\n"), HasSubstr("images.txt contains no image"));
  // Each file is named where it is at fault.
  EXPECT_THAT(reason(camera, "1 1 0 0 0 0 0 x 1 a.png\n"), HasSubstr("images.txt:1: 'x' is not a number"));
  EXPECT_THAT(reason("1 PINHOLE 640 0 600 600 320 240\n", "# 1\n# 2\n" + image),
              HasSubstr("cameras.txt:1: camera 1: "));
}

TEST(RigPair, OfColmapIsNamedAfterFoldersIfImagesHaveOneName) {
  const auto names = [](const std::vector<std::string>& images) {
    std::string lines;
    for (const std::string& image : images) lines += "1 1 0 0 0 0 0 3 1 " + image + "\n\n";
    const auto rig = ReadRigPair("1 PINHOLE 640 480 600 600 320 240\n", lines, "cameras.txt", "images.txt");
    std::string text = rig ? "" : ToString(rig.error());
    for (const NamedCamera& camera : rig ? rig->cameras : std::vector<NamedCamera>{}) text += camera.name + " ";
    return text;
  };
  EXPECT_EQ(names({"cam1/000001.png", "cam2/000001.png"}), "cam1 cam2 ");
  EXPECT_EQ(names({"cam1/a.png", "cam2/b.png"}), "a b ") << "the images' own names";
  EXPECT_EQ(names({"take/cam1/images/1.png", "take/cam2/images/1.png"}), "cam1 cam2 ");
  EXPECT_THAT(names({"cam1/1.png", "cam1/2.png", "cam2/1.png"}),
              HasSubstr("images.txt: 3 images do not have different file names or different folder names"));
  EXPECT_THAT(names({"1.png", "cam2/1.png"}), HasSubstr("images.txt: 2 images"));
}

}  // namespace
}  // namespace etude
