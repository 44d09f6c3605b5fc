// Complaints of readers of rigs and point pairs about files damaged line by line, and how often they accept such files.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "engine/cameras/opencv_file.h"
#include "engine/cameras/pairs_file.h"
#include "engine/cameras/rig_file.h"
#include "tests/engine/cameras/camera_at.h"
#include "tests/support/kept_lines.h"

namespace etude {
namespace {

using testing::ComplaintLines;

/// Returns the text with each line removed, truncated or doubled, and each number replaced.
std::vector<std::string> Spoilt(const std::string& text) {
  std::vector<std::string> spoilt = {text};
  const auto read = [&](const std::string& changed) { spoilt.push_back(changed); };
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1) {
    const std::size_t length = text.find('\n', at) + 1 - at;
    const auto changed = [&](const std::string& line) { return std::string(text).replace(at, length, line); };
    const std::string line = text.substr(at, length);
    for (const std::string& other : {std::string(), line + line, line.substr(0, length / 2) + "\n", " \t" + line})
      read(changed(other));
  }
  constexpr std::array kNumbers = {"x", "-7", "", "0", "1e12", "nan", "2.5", "1, 2"};
  std::size_t next = 0;
  for (std::size_t at = text.find_first_of("0123456789"); at < text.size();) {
    const std::size_t end = std::min(text.find_first_not_of("0123456789.e-", at), text.size());
    for (int i = 0; i < 2; ++i) read(std::string(text).replace(at, end - at, kNumbers[next++ % kNumbers.size()]));
    at = std::min(text.find_first_of("0123456789", end), text.size());
  }
  return spoilt;
}

Result<RigFile> ReadRigText(const std::string& text) { return ReadRigFile(text, "rig"); }

std::vector<NamedCamera> CamerasOfAllKinds() {
  std::vector<NamedCamera> cameras;
  const std::vector<Distortion> lenses = {
      {},
      {.k1 = 0.3, .k2 = -0.08},
      {.k1 = 0.2, .k2 = 0.05, .p1 = 0.002, .p2 = -0.007, .k3 = 0.02, .k4 = 0.1, .k5 = -0.03, .k6 = 0.01},
      {.k1 = -0.25, .k2 = 0.06, .s1 = 0.01, .s2 = -0.006, .s3 = 0.02, .s4 = 0.004},
      {.k1 = 0.15, .tau_x = 0.06, .tau_y = -0.09},
      {.k1 = 0.08, .k2 = -0.02, .k3 = 0.01, .k4 = 0.006, .is_fisheye = true}};
  for (std::size_t i = 0; i < lenses.size(); ++i) {
    const Intrinsics in{
        .width = 640, .height = 480, .fx = 610.5, .fy = 588.25, .cx = 318, .cy = 236.5, .skew = i % 2 ? 3. : 0};
    cameras.push_back(
        {fmt::format("{} cam-{}", i, i), LookAt(in, EyeAt(-60 + 40. * static_cast<double>(i)), {0, 0.9, 0})});
    cameras.back().camera.distortion = lenses[i];
  }
  return cameras;
}

/// Truncates numbers after nine decimals, because the last ones depend on the mathematics library.
std::string NineDecimals(const std::string& text) {
  std::string cut;
  for (std::size_t i = 0, decimals = 0; i < text.size(); ++i) {
    decimals = text[i] == '.' ? 1 : decimals > 0 && std::isdigit(text[i]) ? decimals + 1 : 0;
    if (decimals < 11) cut += text[i];
  }
  return cut;
}

TEST(RigFile, ComplaintsAboutOwnFormatsAreAsTheyWere) {
  const auto cameras = CamerasOfAllKinds();
  const std::span<const NamedCamera> two = std::span(cameras).subspan(1, 2);
  std::string caliscope = NineDecimals(WritePose2SimCalibration(two.first(1)));
  caliscope.replace(0, caliscope.find(']'), "[cameras.12");
  ComplaintLines complaints;
  complaints.Add("rig.yaml", Spoilt(NineDecimals(WriteRig(two))), ReadRigText);
  complaints.Add("OpenCV", Spoilt(NineDecimals(WriteOpenCvCamera(cameras[5].camera))), ReadRigText);
  complaints.Add(
      "Pose2Sim",
      Spoilt("# by hand\n" + NineDecimals(WritePose2SimCalibration(two.first(1))) +
             "[cameras.3]\nignore = true\nmatrix = [ [1, 0,\n 2],[0, 3, 4], # K\n [0, 0, 1]]\nsize = [9, 8]\n"
             "distortions = []\nrotation = [[1.0001, 0, 0], [0, 1, 0], [0, 0, 1]]\ntranslation = [0, \"#\", "
             "1]\nfisheye = true\n"),
      ReadRigText);
  complaints.Add("Caliscope", Spoilt(caliscope), ReadRigText);
  std::vector<NamedCamera> many;
  while (many.size() < 65) many.push_back({fmt::format("c{}", many.size()), cameras[0].camera});
  for (const std::size_t count : {64, 65}) {
    const auto some = std::span(many).first(count);
    complaints.Add(fmt::format("{} cameras", count), std::vector{WriteRig(some), WritePose2SimCalibration(some)},
                   ReadRigText);
  }
  for (const std::size_t size : {1 << 20, (1 << 20) + 1}) {
    complaints.Add(fmt::format("{} bytes", size), std::vector{std::string(size, ' ')}, ReadRigText);
  }
  EXPECT_TRUE(testing::AreKept(complaints.lines(), "tests/engine/cameras/rig_complaints.txt"));
}

constexpr const char* kQualisysOfTwo = R"(<?xml version="1.0" encoding="UTF-8"?>
<calibration created="2020-01-01" type="regular">
 <cameras>
  <camera serial="26578" model="Miqus Video">
   <fov_video left="40" top="7" right="1879" bottom="1079"/>
   <transform x="3000" y="10" z="1000" r11="0" r12="1" r13="0" r21="0" r22="0" r23="1" r31="1" r32="0" r33="0"/>
   <intrinsic sensorMinU="64" sensorMaxU="122880" sensorMinV="0" sensorMaxV="69632"
     focalLengthU="107520" focalLengthV="106880" centerPointU="60800" centerPointV="32640" skew="64"
     radialDistortion1="-0.045" radialDistortion2="0.14" radialDistortion3="0.01"
     tangentalDistortion1="0.0006" tangentalDistortion2="-0.0004"/>
  </camera>
  <other/>
  <camera serial="26579">
   <transform x="20" y="-3000" z="900" r11="1" r12="0" r13="0" r21="0" r22="0" r23="1" r31="0" r32="-1" r33="0"/>
   <intrinsic sensorMinU="0" sensorMaxU="16384" sensorMinV="0" sensorMaxV="1080"
     focalLengthU="1680" focalLengthV="1670" centerPointU="950" centerPointV="510" skew="0"
     radialDistortion1="-0.045" radialDistortion2="0.14" radialDistortion3="0"
     tangentalDistortion1="0.0006" tangentalDistortion2="-0.0004"/>
  </camera>
 </cameras>
</calibration>
)";

std::string MatrixText(const std::string& name, const std::vector<double>& values) {
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: 1\n   dt: d\n   data: [ {} ]\n", name, values.size(),
                     fmt::join(values, ", "));
}

TEST(RigFile, ComplaintsAboutFilesOfOthersAreAsTheyWere) {
  const std::vector<double> K = {610, 0, 320, 0, 600, 240, 0, 0, 1}, lens = {-0.1, 0.02, 0.001, -0.002, 0.003};
  const std::vector<double> turned = {0, 1, 0, -1, 0, 0, 0, 0, 1};
  const std::string head = "%YAML:1.0\n---\n";
  const std::string mocap_in = head + "names:\n  - \"a\"\n  - \"b\"\n" + MatrixText("K_a", K) +
                               MatrixText("dist_a", lens) + "H_a: 480\nW_a: 640\n" + MatrixText("K_b", K) +
                               MatrixText("dist_b", {});
  const std::string mocap_out = head + MatrixText("R_a", {0.1, -0.2, 0.3}) + MatrixText("T_a", {1, 2, 3}) +
                                MatrixText("Rot_b", turned) + MatrixText("T_b", {0, -1, 4});
  const std::string stereo_in = head + MatrixText("M1", K) + MatrixText("D1", lens) + MatrixText("M2", K) +
                                MatrixText("D2", {-0.1, 0.02, 0.001, -0.002});
  const std::string stereo_out = head + MatrixText("R", turned) + MatrixText("T", {-1, 0.1, 0.2});
  const std::string colmap_in =
      "# cameras\n1 SIMPLE_PINHOLE 640 480 600 320 240\n2 OPENCV_FISHEYE 640 480 600 610 320 240 0.1 0.01 0.001 0.002\n"
      "3 FULL_OPENCV 640 480 600 610 320 240 0.1 0.01 0.001 0.002 0.003 0.004 0.005 0.006\n\n"
      "4 SIMPLE_RADIAL_FISHEYE 640 480 600 320 240 0.03\n";
  const std::string colmap_out =
      "# images\n1 0.9 0.1 0.2 0.3 1 2 3 1 a/b.c.png\n5 6 7\n2 1 0 0 0 0 0 4 2 left\n\n3 0 1 0 0 1 0 4 3 x.jpg\n1 2 3\n"
      "4 0 0 2 0 1 1 4 4 /y\n";
  ComplaintLines complaints;
  complaints.Add("Qualisys", Spoilt(kQualisysOfTwo), ReadRigText);
  for (const auto& [what, inside, outside] : {std::tuple("easymocap", mocap_in, mocap_out),
                                              {"stereo", stereo_in, stereo_out},
                                              {"COLMAP", colmap_in, colmap_out}}) {
    complaints.Add(std::string(what) + ", cameras", Spoilt(inside),
                   [&, &out = outside](const std::string& text) { return ReadRigPair(text, out, "pair", "other"); });
    complaints.Add(std::string(what) + ", places", Spoilt(outside),
                   [&, &in = inside](const std::string& text) { return ReadRigPair(in, text, "pair", "other"); });
  }
  for (const std::string cameras : {"", "<cameras/>", "<cameras><camera/></cameras>"}) {
    complaints.Add("'" + cameras + "'", std::vector{"<calibration>" + cameras + "</calibration>"}, ReadRigText);
  }
  complaints.Add("a camera",
                 std::vector<std::string>{"1", "1 PINHOLE 640", "1 PINHOLE 640 480", "1 PINHOLE 640 480 600"},
                 [&](const std::string& text) { return ReadRigPair(text, colmap_out, "pair", "other"); });
  EXPECT_TRUE(testing::AreKept(complaints.lines(), "tests/engine/cameras/complaints_of_others.txt"));
}

TEST(PointPairs, ComplaintsAreAsTheyWere) {
  const auto read = [](const std::string& text) { return ReadPointPairs(text, "pairs"); };
  ComplaintLines complaints;
  complaints.Add("CSV",
                 Spoilt("camera, x,y,\tz,u,v\r\nleft,1,2,3,4,5\n\n# right, too\nright , 1.5,2, 3,100,200\r\n"
                        "left,-1e9,1e9,0,0,0\n"),
                 read);
  complaints.Add("YAML",
                 Spoilt("left:\n  size: [1920, 1080]\n  pairs:\n    - [1, 2, 3, 4, 5]\n    - [0.5, 0, 0, 10, 20]\n"
                        "right: {size: [65536, 1], pairs: [[1, 2, 3, 1000000000, -1000000000]]}\n"),
                 read);
  for (const int count : {64, 65}) {
    std::string text = "camera,x,y,z,u,v\n";
    for (int i = 0; i < count; ++i) text += fmt::format("c{},1,2,3,4,{}\n", i, i);
    complaints.Add(fmt::format("{} cameras", count), std::vector{text}, read);
  }
  for (const std::string text :
       {"", "camera,x,y,z,u,v", "- 1", "7", "a: 1", "a: {size: [2, 3]}", "a: {size: [2, 3], pairs: 4}",
        "a: {size: [2, 3], pairs: [5]}", "a: {size: [2, 3], pairs: [[1, 2, 3, 4]]}", "a: {size: [2, 3], pairs: []}",
        "a: {size: [2, 3], pairs: [[1, 2, 3, 4, 5, 6]]}", "a: {size: [2, 3.5], pairs: []}",
        "a: {size: [2.5, 3], pairs: []}", "a: {pairs: []}", "a: {size: [2], pairs: []}",
        "a: {size: [2, 65537], pairs: []}"})
    complaints.Add("'" + text + "'", std::vector{text}, read);
  const std::string long_comment = "camera,x,y,z,u,v\nleft,1,2,3,4,5\n#";
  for (const std::size_t size : {1 << 20, (1 << 20) + 1}) {
    complaints.Add(fmt::format("{} bytes", size),
                   std::vector{long_comment + std::string(size - long_comment.size(), ' ')}, read);
  }
  EXPECT_TRUE(testing::AreKept(complaints.lines(), "tests/engine/cameras/pairs_complaints.txt"));
}

}  // namespace
}  // namespace etude
