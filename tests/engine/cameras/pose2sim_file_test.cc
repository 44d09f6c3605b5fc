#include "engine/cameras/pose2sim_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

NamedCamera Crooked() {
  Camera camera = LookAt({.width = 1088, .height = 1920, .fx = 1681.25, .fy = 1680, .cx = 533, .cy = 948.5},
                         {-2.5, 1.7, 3.1}, {0.1, 0.9, 0.2});
  camera.distortion = {.k1 = -0.11, .k2 = 0.02, .p1 = 0.0011, .p2 = -0.0007};
  return {"cam_01", camera};
}

NamedCamera Plain() { return {"plain", LookAt({}, {0, 1, 4}, {0, 1, 0})}; }

void ExpectAlike(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.intrinsics.width, b.intrinsics.width);
  EXPECT_EQ(a.intrinsics.height, b.intrinsics.height);
  EXPECT_EQ(a.distortion, b.distortion);
  for (const glm::dvec3 point : {glm::dvec3(0.3, 1.5, -0.2), glm::dvec3(-0.4, 0.1, 0.4), glm::dvec3(0, 1, 0)}) {
    const auto in_a = Project(a, point), in_b = Project(b, point);
    ASSERT_TRUE(in_a && in_b);
    EXPECT_LT(glm::length(*in_a - *in_b), 1e-9);
  }
}

TEST(Pose2SimFile, GivesItsCamerasBack) {
  const std::vector<NamedCamera> cameras{Crooked(), Plain()};
  ASSERT_OK(back, ReadPose2SimCalibration(WritePose2SimCalibration(cameras)));
  ASSERT_EQ(back->size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ((*back)[i].name, cameras[i].name);
    ExpectAlike((*back)[i].camera, cameras[i].camera);
  }
}

TEST(Pose2SimFile, GivesNamesBackThatTomlMustQuote) {
  for (const char* name : {"left cam", "a.b", "3 \"x\" \\", "it's", "Käthe", ""}) {
    ASSERT_OK(back, ReadPose2SimCalibration(WritePose2SimCalibration(std::vector{NamedCamera{name, Plain().camera}})));
    EXPECT_EQ(back->front().name, name);
  }
}

TEST(Pose2SimFile, KeepsAThirdRadialCoefficientWhereThereIsOne) {
  NamedCamera camera = Plain();
  camera.camera.distortion = {.k1 = 0.1, .k3 = 0.03};
  ASSERT_OK(back, ReadPose2SimCalibration(WritePose2SimCalibration(std::vector{camera})));
  EXPECT_EQ(back->front().camera.distortion, camera.camera.distortion);
}

/// Returns the numbers after a key, without the library's reader.
std::vector<double> NumbersBehind(const std::string& text, const std::string& key) {
  std::string list = text.substr(text.find("\n" + key + " = ") + key.size() + 4);
  list = list.substr(0, list.find('\n'));
  for (char& c : list) c = c == '[' || c == ']' || c == ',' ? ' ' : c;
  std::vector<double> numbers;
  for (const char* at = list.c_str();;) {
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (end == at) return numbers;
    numbers.push_back(number);
    at = end;
  }
}

// Pose2Sim's use of the file, from OpenCV's documentation: cv::Rodrigues, K (R X + T). It triangulates (x, y, z) with Z
// up, and writes (y, z, x) with Y up.
TEST(Pose2SimFile, ProjectsAsPose2SimWould) {
  const NamedCamera named = Crooked();
  const std::string text = WritePose2SimCalibration(std::vector{named});
  const auto K = NumbersBehind(text, "matrix"), r = NumbersBehind(text, "rotation"),
             t = NumbersBehind(text, "translation");
  ASSERT_EQ(K.size(), 9u);
  ASSERT_EQ(r.size(), 3u);
  ASSERT_EQ(t.size(), 3u);
  const double angle = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
  const glm::dvec3 axis(r[0] / angle, r[1] / angle, r[2] / angle);
  const glm::dvec3 ours(0.4, 1.6, -0.3);
  const glm::dvec3 theirs(ours.z, ours.x, ours.y);  // with Z up; ours is (theirs.y, theirs.z, theirs.x)
  const glm::dvec3 turned = std::cos(angle) * theirs + std::sin(angle) * glm::cross(axis, theirs) +
                            (1 - std::cos(angle)) * glm::dot(axis, theirs) * axis;
  const glm::dvec3 seen = turned + glm::dvec3(t[0], t[1], t[2]);
  Camera pinhole = named.camera;
  pinhole.distortion = {};
  const glm::dvec2 pixel = *Project(pinhole, ours);
  EXPECT_NEAR(K[0] * seen.x / seen.z + K[2], pixel.x - 0.5, 1e-9);
  EXPECT_NEAR(K[4] * seen.y / seen.z + K[5], pixel.y - 0.5, 1e-9);
  EXPECT_EQ(NumbersBehind(text, "distortions"), (std::vector<double>{-0.11, 0.02, 0.0011, -0.0007}));
}

TEST(Pose2SimFile, WritesWhatTomlReadersTakeForRealNumbers) {
  const std::string text = WritePose2SimCalibration(std::vector{Plain()});
  EXPECT_TRUE(
      text.starts_with("[plain]\nname = \"plain\"\nsize = [ 640.0, 480.0]\nmatrix = [ [ 600.0, 0.0, 319.5], "
                       "[ 0.0, 600.0, 239.5], [ 0.0, 0.0, 1.0]]\ndistortions = [ 0.0, 0.0, 0.0, 0.0]\n"))
      << text;
  EXPECT_NE(text.find("fisheye = false\n\n[metadata]\n"), std::string::npos);
}

TEST(Pose2SimFile, ReadsFisheyesMatricesAndListsOverLines) {
  NamedCamera fisheye = Crooked();
  fisheye.camera.distortion = {.k1 = -0.02, .k2 = 0.004, .k3 = -0.001, .k4 = 0.0003, .is_fisheye = true};
  ASSERT_OK(back, ReadPose2SimCalibration(WritePose2SimCalibration(std::vector{fisheye})));
  EXPECT_EQ(back->front().camera.distortion, fisheye.camera.distortion);
  ASSERT_OK(
      caliscope,
      ReadPose2SimCalibration(
          "[cameras.3]\nsize = [640, 480] # px\nmatrix = [\n [600.0, 0.0, 320.0],\n [0.0, 600.0, 240.0],\n [0.0, 0.0, "
          "1.0],\n]\n"
          "distortions = []\nrotation = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]\ntranslation = [0.0, 0.0, "
          "2.0]\n"
          "[cameras.4]\nignore = true\nmatrix = [1]\n"));
  ASSERT_EQ(caliscope->size(), 1u);
  EXPECT_EQ(caliscope->front().name, "cam_3");
  // The file has Z up; the camera looks along its x, which is our z.
  EXPECT_LT(glm::distance(caliscope->front().camera.p_WC, glm::dvec3(0, 0, -2)), 1e-12);
}

/// Returns the names of a file's cameras, or the error message about the file.
std::string NamesIn(const std::string& text) {
  const auto rig = ReadPose2SimCalibration(text);
  if (!rig) return ToString(rig.error());
  std::string names;
  for (const NamedCamera& camera : *rig) names += camera.name + ";";
  return names;
}

TEST(Pose2SimFile, ReadsEveryFormOfTomlInTheFilesOrder) {
  const std::string keys =
      "size = [640, 480]\nmatrix = [[600, 0, 320], [0, 600, 240], [0, 0, 1]]\ndistortions = []\n"
      "rotation = [0, 0, 0.5]\ntranslation = [0, 0, 2]\n";
  EXPECT_EQ(NamesIn("[b]\n" + keys + "[a]\r\n" + keys + "[metadata]\nerror = 0.1\n"), "b;a;");
  EXPECT_EQ(NamesIn("\xEF\xBB\xBF[a]\nname = 'left #1 = \"x\"' # literal\n" + keys), "left #1 = \"x\";");
  EXPECT_EQ(NamesIn("[a]\nname = \"left \\\"#1\\\\\" # basic\n" + keys), "left \"#1\\;");
  EXPECT_EQ(
      NamesIn("[ 'a b' ]\n'size' = [6_40, 0x1e0]\n" + keys.substr(keys.find('\n') + 1) + "[cameras.\"2\"]\n" + keys),
      "a b;cam_2;");
  EXPECT_EQ(NamesIn("[[cameras]]\n" + keys + "[[cameras]]\nname = 'z'\n" + keys), "cam_0;z;");
  std::string inner = keys;
  for (char& c : inner) c = c == '\n' ? ',' : c;
  inner.pop_back();
  EXPECT_EQ(NamesIn("c = {" + inner + "}\n"), "c;");
  EXPECT_EQ(NamesIn("c.size = [640, 480]\nc.matrix = [600, 0, 320, 0, 600, 240, 0, 0, 1]\nc.distortions = []\n"
                    "c.rotation = [0, 0, 0.5]\nc.translation = [0, 0, 2]\n"),
            "c;");
}

TEST(Pose2SimFile, RefusesWhatIsNotTomlOrNoCamera) {
  const std::string keys =
      "size = [640, 480]\nmatrix = [[600, 0, 320], [0, 600, 240], [0, 0, 1]]\ndistortions = []\n"
      "rotation = [0, 0, 0.5]\ntranslation = [0, 0, 2]\n";
  for (const auto& [text, said] :
       {std::pair("[a]\n" + keys + "translation = [0, 0, 3]\n", ":7:15: is not valid TOML: "),
        {"[a]\n" + keys + "\"size\" = [0, 3]\n", "is not valid TOML: "},
        {"[a]\n" + keys + "[a]\n" + keys, ":7:1: is not valid TOML: "},
        {"[a]\n" + keys + "x = 1.\n", ":7:7: is not valid TOML: "},
        {"[a]\nname = 7\n" + keys, ":2:8: camera a: 'name' must be a text in quotes, found 7"},
        {"[a]\nfisheye = 'true'\n" + keys, ":2:11: camera a: 'fisheye' must be true or false, found \"true\""},
        {"[a]\n" + keys.substr(keys.find('\n') + 1) + "size = [640, '480']\n",
         ":6:8: camera a: 'size' must be a list of numbers"},
        {testing::Replaced("[a]\n" + keys, "[0, 0, 0.5]", "[0, 0, 28.6]"),
         ":5:12: camera a: rotation is a turn by 28.6; allowed: at most a whole turn, 6.283, in radians"},
        {"[metadata]\nerror = 1\n", "no camera"}}) {
    EXPECT_NE((":" + NamesIn(text)).find(said), std::string::npos) << NamesIn(text);
  }
}

TEST(Pose2SimFile, ReadsPlannedCameras) {
  // The file has Z up: its (x, y, z) is our (y, z, x).
  const auto planned = [](const std::string& keys) {
    return ReadPose2SimCalibration("[a]\nsize = [800, 600]\n" + keys);
  };
  const std::string seat = "position = [-3, 1, 2]\nlook_at = [0, 1, 1]\n";
  ASSERT_OK(back, planned("fov_deg = 90\n" + seat));
  const Camera& camera = back->front().camera;
  EXPECT_LT(glm::distance(camera.p_WC, glm::dvec3(1, 2, -3)), 1e-12);
  // At a field of view of 90°, a point beside the target by the target's distance is at the picture's edge. A point
  // above the target is higher in the picture.
  const glm::dvec3 target(1, 1, 0);
  const double away = glm::distance(camera.p_WC, target);
  EXPECT_LT(glm::distance(*Project(camera, target), glm::dvec2(400, 300)), 1e-9);
  EXPECT_LT(glm::distance(*Project(camera, target - glm::dvec3(away, 0, 0)), glm::dvec2(800, 300)), 1e-9);
  EXPECT_LT(Project(camera, target + glm::dvec3(0, 0.5, 0))->y, 299);
  for (const auto& [keys, said] :
       {std::pair("fov_deg = 180\n" + seat, "camera a: 'fov_deg' is 180; allowed: 1 to 170"),
        {seat, "camera a has no fov_deg"},
        {"fov = 90\n" + seat, "camera a has no fov_deg; is 'fov' a misspelling of it?"},
        {"fov_dge = 90\n" + seat, "camera a has no fov_deg; is 'fov_dge' a misspelling of it?"},
        {"fov_deg = 90\nposition = [-3, 1, 2]\nlok_at = [0, 1, 1]\n",
         "camera a has no look_at; is 'lok_at' a misspelling of it?"},
        {"fov_deg = 90\nposition = [0, 1, 2]\nlook_at = [0, 1, 1]\n",
         "camera a: 'look_at' is at, above or below the camera's position; allowed: a point at another horizontal "
         "position"},
        {"fov_deg = 90\nposition = [0, 1]\nlook_at = [0, 1, 1]\n", "camera a: position has 2 numbers; allowed: 3"}}) {
    EXPECT_EQ(planned(keys).error().message, said);
  }
  // A key that a planned camera does not have is refused at its place, also a key of calibrated cameras.
  EXPECT_TRUE(planned("name = 'left'\nignore = false\nfov_deg = 90\n" + seat));
  const std::string allowed = "Allowed: name, size, fov_deg, position, look_at, ignore";
  for (const auto& [line, key, hint] : {std::array{"positon = [9, 9, 9]", "positon", "; did you mean 'position'? "},
                                        {"roll_deg = 90", "roll_deg", "; did you mean 'fov_deg'? "},
                                        {"distortions = [-0.4, 0.1, 0, 0]", "distortions", ". "},
                                        {"matrix = [[5000, 0, 400], [0, 5000, 300], [0, 0, 1]]", "matrix", ". "},
                                        {"fisheye = true", "fisheye", ". "}}) {
    const auto refused = planned("fov_deg = 90\n" + std::string(line) + "\n" + seat);
    ASSERT_FALSE(refused) << line;
    EXPECT_EQ(refused.error().message,
              fmt::format("camera a: unknown key of a planned camera '{}'{}{}", key, hint, allowed));
    EXPECT_EQ(refused.error().place.line, 4);
  }
}

}  // namespace
}  // namespace etude
