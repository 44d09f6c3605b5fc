// Golden values of whole results, of noisy input, fits that are cut off early, and files that are spoilt line by line:
// whatever changes a number or a word is noticed. What is right is said by the tests beside.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include "engine/cameras/camera_parameters.h"
#include "engine/cameras/opencv_file.h"
#include "engine/cameras/pairs_file.h"
#include "engine/cameras/planes.h"
#include "engine/cameras/rig_file.h"
#include "engine/cameras/robust_triangulation.h"
#include "tests/engine/cameras/camera_at.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Fingerprint;

/// Within ±1000, so that numbers of wrong files do not hide those of right ones.
double Bounded(double x) { return x / (1 + 0.001 * std::abs(x)); }

void AddCamera(Fingerprint& print, const Camera& camera) {
  const Intrinsics& in = camera.intrinsics;
  const Distortion& d = camera.distortion;
  print.Add(d.is_fisheye).Add(in.width).Add(in.height);
  for (const double value : {in.fx, in.fy, in.cx, in.cy, in.skew, camera.p_WC.x, camera.p_WC.y, camera.p_WC.z})
    print.Add(Bounded(value));
  for (const double c : {d.k1, d.k2, d.p1, d.p2, d.k3, d.k4, d.k5, d.k6, d.s1, d.s2, d.s3, d.s4, d.tau_x, d.tau_y})
    print.Add(Bounded(100 * c));
  for (int i = 0; i < 3; ++i) print.Add(camera.R_CW[i]);
}

Distortion AnyLens(testing::Dice& dice, int kind) {
  const auto some = [&](double most) { return most * dice.Signed(); };
  Distortion d{.k1 = some(0.4), .k2 = some(0.1), .k3 = some(0.03)};
  if (kind > 0) d.p1 = some(0.01), d.p2 = some(0.01);
  if (kind == 2) d.k4 = some(0.1), d.k5 = some(0.05), d.k6 = some(0.02);
  if (kind == 3) d.s1 = some(0.02), d.s2 = some(0.01), d.s3 = some(0.02), d.s4 = some(0.01);
  if (kind == 4) d.tau_x = some(0.1), d.tau_y = some(0.1);
  if (kind == 5) d = {.k1 = some(0.1), .k2 = some(0.05), .k3 = some(0.02), .k4 = some(0.01), .is_fisheye = true};
  return d;
}

Camera AnyCamera(testing::Dice& dice, int kind) {
  const Intrinsics in{.width = 640,
                      .height = 480,
                      .fx = 600 + 90 * dice.Signed(),
                      .fy = 600 + 90 * dice.Signed(),
                      .cx = 320 + 20 * dice.Signed(),
                      .cy = 240 + 20 * dice.Signed(),
                      .skew = kind % 2 ? 5 * dice.Signed() : 0};
  const glm::dvec3 eye = EyeAt(180 * dice.Signed()), aside = 0.4 * dice.Vector();
  Camera camera = LookAt(in, eye + aside, {0, 0.9, 0});
  if (kind >= 0) camera.distortion = AnyLens(dice, kind);
  return camera;
}

TEST(CamerasGolden, LensesToTheirFoldsAndBeyond) {
  testing::Dice dice(1);
  Fingerprint rays, print;
  for (int k = 0; k < 180; ++k) {
    const Camera camera = AnyCamera(dice, k % 6);
    for (int i = 0; i < 60; ++i) {
      const glm::dvec2 ray = 1.6 * glm::dvec2(dice.Vector());
      rays.Add(Distort(camera.distortion, 0.5 * ray)).Add(Undistort(camera.distortion, ray));
      const glm::dvec2 pixel = glm::dvec2(320, 240) + 900.0 * glm::dvec2(dice.Vector());
      print.Add(DistortPixel(camera, pixel)).Add(UndistortPixel(camera, pixel));
      print.Add(Project(camera, 5.0 * dice.Vector()));
    }
  }
  EXPECT_TRUE(rays.Is(47528, 3785.14464077));
  for (const std::string& name : CalibrationNames()) print.Add(name).Add(CalibrationNamed(name));
  EXPECT_TRUE(print.Is(78940, 1109921.59461));
}

/// Points of a box about the middle, as `camera` shows them, each off by `noise_px` at most.
std::vector<PointPair> NoisyPairs(testing::Dice& dice, const Camera& camera, int count, double noise_px,
                                  const glm::dvec3& extents = glm::dvec3(1)) {
  std::vector<PointPair> pairs;
  while (static_cast<int>(pairs.size()) < count) {
    const glm::dvec3 world = extents * dice.Vector() + glm::dvec3(0, 0.9, 0);
    const glm::dvec2 off = noise_px * glm::dvec2(dice.Vector());
    if (const auto pixel = Project(camera, world)) pairs.push_back({world, *pixel + off});
  }
  return pairs;
}

TEST(CamerasGolden, MatricesOfNoisyPairs) {
  testing::Dice dice(2);
  Fingerprint print;
  for (int k = 0; k < 40; ++k) {
    const Camera camera = AnyCamera(dice, -1 - k % 2);
    // From a volume to nearly a plane, to nearly a line.
    const double flat = std::pow(10.0, -0.2 * k);
    const auto pairs = NoisyPairs(dice, camera, 6 + k / 2, 2, {1, k % 3 ? 1 : flat, k < 4 ? 1 : flat});
    for (const Calibration calibration : {Calibration::kDlt, Calibration::kDltNormalised, Calibration::kRefined}) {
      const auto matrix = Calibrate(pairs, calibration);
      if (!matrix) print.Add(matrix.error().message);
      if (!matrix) continue;
      for (const auto& row : matrix->h) print.Add(row);
      print.Add(ReprojectionRms(*matrix, pairs));
      if (const auto p = Decompose(*matrix)) {
        print.Add(p->focal_length).Add(p->delta_u).Add(p->skew).Add(p->omega).Add(p->phi).Add(p->kappa).Add(p->t);
        AddCamera(print, ToCamera(*p, 640, 480));
      }
    }
  }
  EXPECT_TRUE(print.Is(8666, 4772.71927985));
}

TEST(CamerasGolden, DirectionsAndPointsSeenByManyCamerasOfWhichSomeErr) {
  testing::Dice dice(3);
  Fingerprint limbs, points;
  for (int k = 0; k < 150; ++k) {
    const int count = 2 + k % 5;
    const glm::dvec3 a = glm::dvec3(0, 0.9, 0) + 0.6 * dice.Vector(), b = a + 0.5 * dice.Vector();
    std::vector<LimbSighting> strokes;
    std::vector<Sighting> plain;
    std::vector<InformedSighting> informed;
    std::vector<WeightedSighting> weighted;
    std::vector<double> weights;
    for (int c = 0; c < count; ++c) {
      const double away = dice.Below(4) == 0 ? 120 : 3;
      const auto off = [&] { return away * glm::dvec2(dice.Vector()); };
      ProjectionMatrix matrix = MatrixOf(AnyCamera(dice, -1));
      for (auto& row : matrix.h) {
        for (double& h : row) h *= 1 + c;  // of any scale
      }
      const glm::dvec2 at_a = *Project(matrix, a) + off(), at_b = dice.Below(7) ? *Project(matrix, b) + off() : at_a;
      strokes.push_back({matrix, {at_a, at_b}});
      plain.push_back({matrix, at_a});
      glm::dmat2 information{2 + dice.Signed(), 0.5, 0.5, 1 + 0.5 * dice.Signed()};
      informed.push_back({plain.back(), information});
      weighted.push_back({plain.back(), dice.Below(6) ? 1 + 0.9 * dice.Signed() : -dice.Below(2)});
      weights.push_back(1 + 0.5 * dice.Signed());
      const auto line = SightLineOf(plain.back());
      points.Add(line->camera_W).Add(line->direction_W).Add(NearestOn(*line, b)).Add(NearestOn(*line, 9.0 * a));
      if (c > 0) points.Add(EpipolarGeometry::Of(plain[0].matrix, matrix)->DistancePx(plain[0].pixel, at_a));
    }
    for (const double smallest : {Radians(3), 0.0, Radians(30)}) {
      const LimbDirection limb = ComputeLimbDirection(strokes, smallest);
      limbs.Add(limb.status).Add(limb.direction).Add(limb.plane_angle);
    }
    for (const double tolerance : {5.0, 25.0}) {
      limbs.Add(AgreeingViews(strokes, tolerance));
      points.Add(AgreeingViews(plain, tolerance)).Add(AgreeingViews(plain, tolerance, weights));
      if (const auto robust = TriangulateRobustly(weighted, {tolerance}))
        points.Add(robust->position).Add(robust->agrees).Add(robust->residual_px);
    }
    for (const TriangulatedPoint& point : {Triangulate(plain), TriangulateByPixels(plain)})
      points.Add(point.status).Add(point.position).Add(point.residual_px);
    if (const auto alike = TriangulateRobustly(std::vector<WeightedSighting>{{plain[0]}, {plain[1]}}))
      points.Add(alike->position).Add(alike->residual_px);
    if (const auto likeliest = TriangulateLikeliest(informed)) points.Add(likeliest->position);
    const auto equations = PointEquationsAt(informed, a);
    for (int i = 0; i < 3; ++i) points.Add(1e-4 * equations->information[i]);
    points.Add(1e-2 * equations->right);
  }
  EXPECT_TRUE(limbs.Is(3362, -71.2525456552));
  EXPECT_TRUE(points.Is(16665, -2460.98813526));
}

void AddRig(Fingerprint& print, const Result<RefinedRig>& rig) {
  if (!rig) return void(print.Add(rig.error().message));
  for (const Camera& camera : rig->cameras) AddCamera(print, camera);
  for (const TargetPlace& t : rig->targets) print.Add(t.R_WT[0]).Add(t.R_WT[1]).Add(t.R_WT[2]).Add(t.p_WT);
  print.Add(rig->camera_rms_px).Add(rig->rms_px).Add(rig->points).Add(rig->parameters);
  for (const IntrinsicsDeviation& d : rig->deviations) print.Add(d.fx).Add(d.fy).Add(d.cx).Add(d.cy);
}

TEST(CamerasGolden, CamerasRefinedForAFewSteps) {
  testing::Dice dice(4);
  Fingerprint print;
  for (int k = 0; k < 10; ++k) {
    const Camera camera = AnyCamera(dice, k % 3 - 1);
    const auto pairs = NoisyPairs(dice, camera, k == 9 ? 6 : 15 + k, 1.5, {1, 0.7, k == 8 ? 0.002 : 0.8});
    for (const LensModel lens :
         {LensModel::kPinhole, LensModel::kRadial2, LensModel::kRadial3, LensModel::kAsInCamera}) {
      RefineOptions options{.lens = lens, .skew = k % 2 == 1};
      AddRig(print, RefineCamera(pairs, 640, 480, options));
      options.most_iterations = 1 + k % 3;
      AddRig(print, RefineCamera(pairs, 640, 480, options));
    }
  }
  EXPECT_TRUE(print.Is(4448, -1365.51649555));
}

/// Boards of 6 × 4 corners as three cameras show them, with noise; some views are missing or cut off.
std::vector<TargetView> ViewsOfBoards(testing::Dice& dice, const std::vector<Camera>& cameras, int boards) {
  std::vector<TargetView> views;
  for (int b = 0; b < boards; ++b) {
    glm::dquat turn = dice.Rotation();
    turn = glm::normalize(glm::dquat(2, turn.x, turn.y, turn.z));
    const glm::dvec3 p_WT = glm::dvec3(-0.2, 1.1, 0) + 0.4 * dice.Vector();
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      if (dice.Below(5) == 0) continue;
      TargetView view{c, static_cast<std::size_t>(b + (b > 2)), {}};  // there is no board 3
      const int corners = dice.Below(6) ? 24 : static_cast<int>(dice.Below(9));
      for (int i = 0; i < corners; ++i) {
        const glm::dvec3 place(0.09 * (i % 6), 0.08 * (i / 6), 0);
        const glm::dvec2 off = 0.7 * glm::dvec2(dice.Vector());
        if (const auto pixel = Project(cameras[c], p_WT + turn * place)) view.pairs.push_back({place, *pixel + off});
      }
      views.push_back(std::move(view));
    }
  }
  return views;
}

TEST(CamerasGolden, RigsFromBoards) {
  testing::Dice dice(5);
  Fingerprint rigs, planes;
  for (int k = 0; k < 4; ++k) {
    std::vector<Camera> cameras;
    for (const double degrees : {-30.0, 5.0, 35.0}) {
      const Intrinsics in{.width = 640, .height = 480, .fx = 500.0 + 20 * k, .fy = 540, .cx = 324, .cy = 236};
      cameras.push_back(LookAt(in, EyeAt(degrees), {0, 1, 0}));
      cameras.back().distortion = {.k1 = -0.1, .k2 = 0.03};
    }
    const auto views = ViewsOfBoards(dice, cameras, 4 + k);
    const std::vector<PictureSize> sizes(3, PictureSize{640, 480});
    AddRig(rigs, CalibrateFromPlanes(sizes, views));
    for (const int iterations : {1, 2, 4}) {
      const RefineOptions options{.lens = k % 2 ? LensModel::kRadial3 : LensModel::kPinhole,
                                  .most_iterations = iterations};
      AddRig(rigs, CalibrateFromPlanes(sizes, views, options));
    }
    AddRig(rigs, PlaceBoards(cameras, views));
    RigGuess guess{cameras, {}};
    if (const auto placed = PlaceBoards(cameras, views)) guess.targets = placed->targets;
    guess.cameras[1].p_WC += 0.02;
    AddRig(rigs, RefineRig(guess, std::span(views).first(2), {.hold_intrinsics = true}));
    std::vector<glm::dmat3> homographies;
    for (const TargetView& view : views) {
      const auto homography = HomographyOf(view.pairs);
      if (!homography) planes.Add(homography.error().message);
      if (!homography) continue;
      const TargetPlace pose = PoseOfPlane(cameras[view.camera].intrinsics, *homography);
      const glm::dmat3& H = *homography;
      const double size = glm::length(H[2]) * (H[2].z < 0 ? -1 : 1);
      for (int i = 0; i < 3; ++i) {
        planes.Add(pose.R_WT[i]).Add(Bounded(pose.p_WT[i]));
        for (int row = 0; row < 3; ++row) planes.Add(Bounded(H[i][row] / size));
      }
      homographies.push_back(*homography);
      // One view, two, …: until they tell.
      const auto in = IntrinsicsFromPlanes(homographies, 640, 480);
      if (in) planes.Add(in->fx).Add(in->fy).Add(in->cx).Add(in->cy).Add(in->skew).Add(in->width).Add(in->height);
    }
  }
  EXPECT_TRUE(rigs.Is(3495, -1190.10205386));
  EXPECT_TRUE(planes.Is(1481, -636.162407991));
}

/// Calls `read` with the text, without each of its lines in turn, with each cut off or doubled, with each of its
/// numbers replaced by others.
template <typename Read>
void ForEachSpoilt(const std::string& text, const Read& read) {
  read(text);
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
}

struct FilePrints {
  Fingerprint cameras, complaints;

  void Add(const Result<RigFile>& rig) {
    if (!rig) return void(complaints.Add(ToString(rig.error())));
    for (const NamedCamera& named : rig->cameras) {
      complaints.Add(named.name);
      AddCamera(cameras, named.camera);
    }
    complaints.Add(rig->format).Add(rig->has_unit);
    cameras.Add(rig->unit_m).Add(rig->R_WF[0]).Add(rig->R_WF[1]);
  }
};

std::vector<NamedCamera> CamerasOfAllKinds() {
  testing::Dice dice(6);
  std::vector<NamedCamera> cameras;
  for (const int kind : {-1, 0, 2, 3, 4, 5})
    cameras.push_back({fmt::format("{} cam-{}", kind, kind), AnyCamera(dice, kind)});
  cameras[1].camera.distortion.k3 = 0;
  return cameras;
}

/// Without what stands beyond a number's ninth decimal: the last ones are the mathematics library's.
std::string NineDecimals(const std::string& text) {
  std::string cut;
  for (std::size_t i = 0, decimals = 0; i < text.size(); ++i) {
    decimals = text[i] == '.' ? 1 : decimals > 0 && std::isdigit(text[i]) ? decimals + 1 : 0;
    if (decimals < 11) cut += text[i];
  }
  return cut;
}

TEST(CamerasGolden, RigsWrittenReadAndSpoilt) {
  const auto cameras = CamerasOfAllKinds();
  Fingerprint texts;
  texts.Add(NineDecimals(WriteRig(cameras))).Add(NineDecimals(WritePose2SimCalibration(cameras)));
  for (const NamedCamera& named : cameras) texts.Add(NineDecimals(WriteOpenCvCamera(named.camera)));
  EXPECT_TRUE(texts.Is(10597, 737.868805496));
  FilePrints prints;
  const auto read = [&](const std::string& text) { prints.Add(ReadRigFile(text, "rig")); };
  read(WriteRig(cameras));
  read(WritePose2SimCalibration(cameras));
  for (const NamedCamera& named : cameras) read(WriteOpenCvCamera(named.camera));
  const std::span<const NamedCamera> two = std::span(cameras).subspan(1, 2);
  ForEachSpoilt(NineDecimals(WriteRig(two)), read);
  ForEachSpoilt(NineDecimals(WriteOpenCvCamera(cameras[5].camera)), read);
  ForEachSpoilt("# by hand\n" + NineDecimals(WritePose2SimCalibration(two.first(1))) +
                    "[cameras.3]\nignore = true\nmatrix = [ [1, 0,\n 2],[0, 3, 4], # K\n [0, 0, 1]]\nsize = [9, 8]\n"
                    "distortions = []\nrotation = [[1.0001, 0, 0], [0, 1, 0], [0, 0, 1]]\ntranslation = [0, \"#\", "
                    "1]\nfisheye = true\n",
                read);
  std::string caliscope = NineDecimals(WritePose2SimCalibration(two.first(1)));
  caliscope.replace(0, caliscope.find(']'), "[cameras.12");
  ForEachSpoilt(caliscope, read);
  std::vector<NamedCamera> many;
  while (many.size() < 65) many.push_back({fmt::format("c{}", many.size()), cameras[0].camera});
  for (const std::size_t count : {64, 65}) read(WriteRig(std::span(many).first(count)));
  for (const std::size_t count : {64, 65}) read(WritePose2SimCalibration(std::span(many).first(count)));
  for (const std::size_t size : {1 << 20, (1 << 20) + 1}) read(std::string(size, ' '));
  EXPECT_TRUE(prints.cameras.Is(23009, -4832.17023284));
  EXPECT_TRUE(prints.complaints.Is(38902, 7710.76124717));
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

TEST(CamerasGolden, FilesOfOthersSpoilt) {
  FilePrints prints;
  ForEachSpoilt(kQualisysOfTwo, [&](const std::string& text) { prints.Add(ReadRigFile(text, "rig")); });
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
  for (const auto& [inside, outside] :
       {std::pair(mocap_in, mocap_out), {stereo_in, stereo_out}, {colmap_in, colmap_out}}) {
    ForEachSpoilt(inside, [&, &out = outside](const std::string& text) { prints.Add(ReadRigPair(text, out, "pair")); });
    ForEachSpoilt(outside, [&, &in = inside](const std::string& text) { prints.Add(ReadRigPair(in, text, "pair")); });
  }
  for (const std::string cameras : {"", "<cameras/>", "<cameras><camera/></cameras>"})
    prints.Add(ReadRigFile("<calibration>" + cameras + "</calibration>", "rig"));
  for (const std::string camera : {"1", "1 PINHOLE 640", "1 PINHOLE 640 480", "1 PINHOLE 640 480 600"})
    prints.Add(ReadRigPair(camera, colmap_out, "pair"));
  EXPECT_TRUE(prints.cameras.Is(34222, 95356.3822573));
  EXPECT_TRUE(prints.complaints.Is(39331, 9249.32456452));
}

TEST(CamerasGolden, PointPairsReadAndSpoilt) {
  Fingerprint pairs, complaints;
  const auto read = [&](const std::string& text) {
    const auto cameras = ReadPointPairs(text, "pairs");
    if (!cameras) return void(complaints.Add(ToString(cameras.error())));
    for (const CameraPairs& camera : *cameras) {
      complaints.Add(camera.name);
      pairs.Add(camera.width).Add(camera.height);
      for (const auto& [p, pixel] : camera.pairs) {
        for (const double x : {p.x, p.y, p.z, pixel.x, pixel.y}) pairs.Add(Bounded(x));
      }
    }
  };
  ForEachSpoilt(
      "camera, x,y,\tz,u,v\r\nleft,1,2,3,4,5\n\n# right, too\nright , 1.5,2, 3,100,200\r\nleft,-1e9,1e9,0,0,0\n", read);
  ForEachSpoilt(
      "left:\n  size: [1920, 1080]\n  pairs:\n    - [1, 2, 3, 4, 5]\n    - [0.5, 0, 0, 10, 20]\n"
      "right: {size: [65536, 1], pairs: [[1, 2, 3, 1000000000, -1000000000]]}\n",
      read);
  for (const int count : {64, 65}) {
    std::string text = "camera,x,y,z,u,v\n";
    for (int i = 0; i < count; ++i) text += fmt::format("c{},1,2,3,4,{}\n", i, i);
    read(text);
  }
  for (const std::string text :
       {"", "camera,x,y,z,u,v", "camera,x,y,z,u,v\nleft,1,2,3,4,5", "- 1", "7", "a: 1", "a: {size: [2, 3]}",
        "a: {size: [2, 3], pairs: 4}", "a: {size: [2, 3], pairs: [5]}", "a: {size: [2, 3], pairs: [[1, 2, 3, 4]]}",
        "a: {size: [2, 3], pairs: []}", "a: {size: [2, 3], pairs: [[1, 2, 3, 4, 5, 6]]}",
        "a: {size: [2, 3.5], pairs: []}", "a: {size: [2.5, 3], pairs: []}", "a: {pairs: []}",
        "a: {size: [2], pairs: []}", "a: {size: [2, 65537], pairs: []}"})
    read(text);
  const std::string long_comment = "camera,x,y,z,u,v\nleft,1,2,3,4,5\n#";
  for (const std::size_t size : {1 << 20, (1 << 20) + 1})
    read(long_comment + std::string(size - long_comment.size(), ' '));
  EXPECT_TRUE(pairs.Is(799, -111716.052188));
  EXPECT_TRUE(complaints.Is(8127, 3547.46593967));
}

}  // namespace
}  // namespace etude
