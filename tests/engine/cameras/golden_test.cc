// The golden value of calibration: cameras and boards refined from noisy views. The other tests of this folder check
// that results are right.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/cameras/planes.h"
#include "tests/engine/cameras/camera_at.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Fingerprint;

/// Limits numbers to ±1000, so that diverged rigs do not hide the others.
double Bounded(double x) { return x / (1 + 0.001 * std::abs(x)); }
glm::dvec3 Bounded(const glm::dvec3& p) { return {Bounded(p.x), Bounded(p.y), Bounded(p.z)}; }

void AddRig(Fingerprint& print, const Result<RefinedRig>& rig) {
  print.Add(rig.has_value());
  if (!rig) return;
  for (const auto& [in, R_CW, p_WC, d] : rig->cameras) {
    for (const double x : {in.fx, in.fy, in.cx, in.cy, 100 * d.k1, 100 * d.k2, 100 * d.k3}) print.Add(Bounded(x));
    print.Add(R_CW[0]).Add(R_CW[1]).Add(Bounded(p_WC));
  }
  for (const CalibrationTargetPose& t : rig->targets) print.Add(t.R_WT[0]).Add(t.R_WT[1]).Add(t.R_WT[2]).Add(Bounded(t.p_WT));
  print.Add(Bounded(rig->rms_px)).Add(rig->points).Add(rig->parameters);
  for (const IntrinsicsDeviation& d : rig->deviations) {
    for (const double x : {d.fx, d.fy, d.cx, d.cy}) print.Add(Bounded(x));
  }
}

/// Returns three cameras' views of boards of 6 × 4 corners with noise; some views are missing or cut off.
std::vector<TargetView> ViewsOfBoards(testing::Dice& dice, const std::vector<Camera>& cameras, int boards) {
  std::vector<TargetView> views;
  for (int b = 0; b < boards; ++b) {
    glm::dquat turn = dice.Rotation();
    turn = glm::normalize(glm::dquat(2, turn.x, turn.y, turn.z));
    const glm::dvec3 p_WT = glm::dvec3(-0.2, 1.1, 0) + 0.4 * dice.Vector();
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      if (dice.Below(5) == 0) continue;
      TargetView view{c, static_cast<std::size_t>(b + (b > 2)), {}};  // board 3 does not exist
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
  Fingerprint print;
  for (int k = 0; k < 3; ++k) {
    std::vector<Camera> cameras;
    for (const double degrees : {-30.0, 5.0, 35.0}) {
      const Intrinsics in{.width = 640, .height = 480, .fx = 500.0 + 20 * k, .fy = 540, .cx = 324, .cy = 236};
      cameras.push_back(LookAt(in, EyeAt(degrees), {0, 1, 0}));
      cameras.back().distortion = {.k1 = -0.1, .k2 = 0.03};
    }
    const auto views = ViewsOfBoards(dice, cameras, 4 + k);
    const std::vector<PictureSize> sizes(3, PictureSize{640, 480});
    AddRig(print, CalibrateFromPlanes(sizes, views));
    for (const int iterations : {1, 2, 4}) {
      const RefineOptions options{.lens = k % 2 ? LensModel::kRadial3 : LensModel::kPinhole,
                                  .most_iterations = iterations};
      AddRig(print, CalibrateFromPlanes(sizes, views, options));
    }
    AddRig(print, LocateBoards(cameras, views));
    RigGuess guess{cameras, {}};
    if (const auto placed = LocateBoards(cameras, views)) guess.targets = placed->targets;
    guess.cameras[1].p_WC += 0.02;
    AddRig(print, RefineRig(guess, std::span(views).first(2), {.hold_intrinsics = true}));
  }
  EXPECT_TRUE(print.Is(1863, -800.166242423));
}

}  // namespace
}  // namespace etude
