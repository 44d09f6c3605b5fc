// Times the calibration of one camera and its lens from 15 views of a board: Etude's function and, if OpenCV is
// installed, cv::calibrateCamera. Both functions minimise the same sum of squares, so the program also compares their
// results.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/quaternion.hpp>

#include "engine/boards/printed_board.h"
#include "engine/cameras/planes.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

constexpr PictureSize kSize{1280, 720};

std::vector<TargetView> Views() {
  Camera camera;
  camera.intrinsics = {kSize.width, kSize.height, 1010, 1005, 655, 352, 0};
  camera.distortion = {.k1 = -0.12, .k2 = 0.05, .p1 = 0.0008, .p2 = -0.0006};
  RandomStream dice(WorldKey{.suite_seed = 1, .scenario = "calibration-bench", .trial = 0}, "views");
  std::vector<TargetView> views;
  for (std::size_t v = 0; v < 15; ++v) {
    const double yaw = dice.Uniform(-0.7, 0.7), pitch = dice.Uniform(-0.7, 0.7), roll = dice.Uniform(-0.4, 0.4);
    const glm::dmat3 R =
        glm::mat3_cast(glm::angleAxis(yaw, glm::dvec3(0, 1, 0)) * glm::angleAxis(pitch, glm::dvec3(1, 0, 0)) *
                       glm::angleAxis(roll, glm::dvec3(0, 0, 1)));
    const glm::dvec3 t{dice.Uniform(-0.5, 0.1), dice.Uniform(-0.35, 0.05), dice.Uniform(1, 1.6)};
    TargetView view{0, v, {}};
    for (int i = 0; i < 49; ++i) {
      const glm::dvec3 place(0.06 * (i % 7), 0.06 * (i / 7), 0);
      const auto pixel = Project(camera, R * place + t);
      if (pixel) view.pairs.push_back({place, *pixel + 0.2 * glm::dvec2{dice.Normal(), dice.Normal()}});
    }
    views.push_back(std::move(view));
  }
  return views;
}

Result<RefinedRig> CalibrateByUs(std::span<const TargetView> views) { return CalibrateFromPlanes({&kSize, 1}, views); }

void Ours(benchmark::State& state) {
  const std::vector<TargetView> views = Views();
  double rms = 0;
  for (auto _ : state) {
    const auto rig = CalibrateByUs(views);
    if (!rig) std::exit(1);
    rms = rig->rms_px;
  }
  state.counters["rms_px"] = rms;
}
BENCHMARK(Ours)->Unit(benchmark::kMillisecond);

void OpenCv(benchmark::State& state) {
  const std::vector<TargetView> views = Views();
  const auto ours = CalibrateByUs(views);
  if (!ours) std::exit(1);
  Result<OpenCvCalibration> theirs = CalibrateByOpenCv(views, kSize, LensModel::kRadial2);
  if (!theirs) {
    state.SkipWithError(theirs.error().message.c_str());
    return;
  }
  for (auto _ : state) theirs = CalibrateByOpenCv(views, kSize, LensModel::kRadial2);
  const Intrinsics &a = ours->cameras[0].intrinsics, &b = theirs->intrinsics;
  const double apart =
      std::max({std::abs(a.fx - b.fx), std::abs(a.fy - b.fy), std::abs(a.cx - b.cx), std::abs(a.cy - b.cy)});
  constexpr double kMaxApartPx = 0.01;  // pixels; not smaller, because OpenCV takes points as floats
  if (apart > kMaxApartPx || std::abs(ours->rms_px - theirs->rms_px) > 1e-4) {
    std::fprintf(stderr, "the answers differ by %g px, RMS %.6f and %.6f\n", apart, ours->rms_px, theirs->rms_px);
    std::exit(1);
  }
  state.counters["rms_px"] = theirs->rms_px;
  state.counters["apart_px"] = apart;
  state.counters["k1_apart"] = std::abs(ours->cameras[0].distortion.k1 - theirs->distortion.k1);
}
BENCHMARK(OpenCv)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace etude
