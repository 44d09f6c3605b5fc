#include "engine/cameras/opencv_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "engine/cameras/rig_file.h"
#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

Result<Camera> ReadBack(const std::string& text) {
  ASSIGN_OR_RETURN(const auto rig, ReadRig(text, "camera.yaml"));
  return rig.front().camera;
}

/// Returns the numbers of the named matrix, without the library's reader.
std::vector<double> MatrixNamed(const std::string& text, const std::string& name) {
  std::size_t at = text.find("\n" + name + ": !!opencv-matrix");
  at = text.find("data: [", at) + 7;
  std::string list = text.substr(at, text.find(']', at) - at);
  std::replace(list.begin(), list.end(), ',', ' ');
  std::istringstream in(list);
  std::vector<double> numbers;
  for (double number; in >> number;) numbers.push_back(number);
  return numbers;
}

// A second implementation of OpenCV's formula: pixel = K (R X + T), divided by its last entry.
TEST(OpenCvFile, ProjectsAsOpenCvWouldHalfAPixelApart) {
  const Camera camera =
      LookAt({.width = 800, .height = 500, .fx = 610, .fy = 590, .cx = 401, .cy = 239}, {2, 1.2, 3}, {0.1, 0.9, 0.2});
  const std::string text = WriteOpenCvCamera(camera);
  const auto K = MatrixNamed(text, "camera_matrix"), R = MatrixNamed(text, "R"), T = MatrixNamed(text, "T");
  ASSERT_EQ(K.size(), 9u);
  ASSERT_EQ(R.size(), 9u);
  ASSERT_EQ(T.size(), 3u);
  EXPECT_EQ(MatrixNamed(text, "distortion_coefficients"), std::vector<double>(5, 0.0));
  for (const glm::dvec3 X : {glm::dvec3(0.3, 1.5, -0.2), glm::dvec3(-0.6, 0.1, 0.4)}) {
    double c[3], p[3];
    for (int i = 0; i < 3; ++i) c[i] = R[3 * i] * X.x + R[3 * i + 1] * X.y + R[3 * i + 2] * X.z + T[i];
    for (int i = 0; i < 3; ++i) p[i] = K[3 * i] * c[0] + K[3 * i + 1] * c[1] + K[3 * i + 2] * c[2];
    const glm::dvec2 ours = *Project(MatrixOf(camera), X);
    EXPECT_NEAR(p[0] / p[2], ours.x - 0.5, 1e-9);
    EXPECT_NEAR(p[1] / p[2], ours.y - 0.5, 1e-9);
  }
}

// cv::FileStorage refuses a matrix with another number of numbers than rows times columns.
TEST(OpenCvFile, HasAsManyNumbersAsRowsTimesColumns) {
  const std::string text = WriteOpenCvCamera(LookAt({}, {0, 1, 4}, {0, 1, 0}));
  const auto number_behind = [&](const std::string& word, std::size_t from) {
    return std::stoul(text.substr(text.find(word, from) + word.size()));
  };
  for (const char* name : {"camera_matrix", "distortion_coefficients", "R", "T"}) {
    const std::size_t at = text.find("\n" + std::string(name) + ":");
    ASSERT_NE(at, std::string::npos) << name;
    EXPECT_EQ(number_behind("rows: ", at) * number_behind("cols: ", at), MatrixNamed(text, name).size()) << name;
  }
}

TEST(OpenCvFile, HasTheHeadAndTheTypesThatFileStorageReads) {
  const std::string text = WriteOpenCvCamera(LookAt({}, {0, 1, 4}, {0, 1, 0}));
  EXPECT_TRUE(text.starts_with("%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\n")) << text;
  EXPECT_NE(
      text.find("camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 600., 0., 319.5, 0., "
                "600., 239.5, 0., 0., 1. ]\n"),
      std::string::npos)
      << text;
}

TEST(OpenCvFile, GivesTheCameraBackWithItsLens) {
  Camera camera = LookAt({.width = 800, .height = 500, .fx = 610, .fy = 590, .cx = 401, .cy = 239, .skew = 1.5},
                         {2, 1.2, 3}, {0.1, 0.9, 0.2});
  camera.distortion = {.k1 = -0.21, .k2 = 0.03, .p1 = 1e-3, .p2 = -2e-3, .k3 = 0.004};
  const std::string text = WriteOpenCvCamera(camera);
  EXPECT_EQ(MatrixNamed(text, "distortion_coefficients"), (std::vector<double>{-0.21, 0.03, 1e-3, -2e-3, 0.004}));
  ASSERT_OK(back, ReadBack(text));
  EXPECT_EQ(back->distortion, camera.distortion);
  EXPECT_EQ(back->intrinsics.width, 800);
  EXPECT_EQ(back->intrinsics.skew, 1.5);
  for (const glm::dvec3 X : {glm::dvec3(0.3, 1.5, -0.2), glm::dvec3(-0.6, 0.1, 0.4)}) {
    EXPECT_LT(glm::length(*Project(*back, X) - *Project(camera, X)), 1e-9);
  }
}

TEST(OpenCvFile, ReadsFourCoefficientsAndNoExtrinsics) {
  ASSERT_OK(
      camera,
      ReadBack(
          "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\n"
          "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 600., 0., 319.5, 0.,\n       "
          "6.1e+02, 239.5, 0., "
          "0., 1. ]\ndistortion_coefficients: !!opencv-matrix\n   rows: 4\n   cols: 1\n   dt: d\n   data: [ -0.1, "
          "0.02, "
          "0., 0.001 ]\n"));
  EXPECT_EQ(camera->intrinsics.fy, 610);
  EXPECT_EQ(camera->intrinsics.cx, 320);
  EXPECT_EQ(camera->distortion, (Distortion{.k1 = -0.1, .k2 = 0.02, .p2 = 0.001}));
  EXPECT_EQ(camera->p_WC, glm::dvec3(0));
}

TEST(OpenCvFile, NeedsItsCameraMatrix) {
  const std::string good = WriteOpenCvCamera(LookAt({}, {0, 1, 4}, {0, 1, 0}));
  EXPECT_NE(testing::Message(ReadBack(testing::Replaced(good, "camera_matrix", "matrix"))).find("no camera_matrix"),
            std::string::npos);
}

}  // namespace
}  // namespace etude
