// Times each camera effect on a picture of 640 × 480 (without drawing the scene), and whole pictures (with drawing).
#include <benchmark/benchmark.h>

#include "sim/camera/camera_model.h"
#include "sim/choreography/canonical_body.h"
#include "sim/render/renderer.h"

namespace etude {
namespace {

constexpr WorldKey kWorld{.suite_seed = 1, .scenario = "micro", .trial = 0};

Camera CameraWith(const CameraEffects& effects) {
  Camera camera = LookAt({}, {-1.2, 1.4, 3.9}, {0, 0.95, 0});
  RandomStream lens(kWorld, "lens");
  camera.distortion = LensDistortion(effects, camera.intrinsics, lens);
  return camera;
}

View RowsOf(const View& all, const RowRange& rows) {
  View view;
  view.colour = ColourImage(all.colour.width, rows.end - rows.first);
  view.labels = LabelImage(all.labels.width, rows.end - rows.first);
  view.depth = DepthImage(all.depth.width, rows.end - rows.first);
  const auto copy = [&](const auto& from, auto& to) {
    std::copy_n(&from.At(0, rows.first), to.pixels.size(), to.pixels.begin());
  };
  copy(all.colour, view.colour);
  copy(all.labels, view.labels);
  copy(all.depth, view.depth);
  return view;
}

/// All camera effects except motion blur and constant errors of exposure and white balance, as strong as in a cheap
/// camera.
constexpr CameraEffects kAll{.sync_offset_ms = 10,
                             .clock_drift_ppm = 100,
                             .rolling_shutter_ms = 20,
                             .radial_distortion = -0.06,
                             .tangential_distortion = 0.005,
                             .defocus_px = 0.8,
                             .vignette = 1,
                             .dust = 0.2,
                             .exposure_drift_ev = 0.2,
                             .gain_db = 6,
                             .white_balance_drift_ev = 0.1,
                             .bayer = 1,
                             .noise = 1,
                             .jpeg_loss = 20};

// Times effects without drawing: the scene is copied from a picture drawn before.
void Effect(benchmark::State& state, const CameraEffects& effects) {
  const auto renderer = Renderer::Create();
  if (!renderer) return state.SkipWithError(renderer.error().message.c_str());
  CameraModel model(CameraWith(effects), effects, 30, {kWorld, "camera", true});
  const View drawn =
      (*renderer)->Render({}, {{BodyCapsules(StandingPose()), PerformerColours()}}, model.pinhole(), Targets::kAll);
  const auto scene = [&](double, const RowRange& rows, Targets) { return RowsOf(drawn, rows); };
  std::size_t frame = 0;
  for (auto _ : state) benchmark::DoNotOptimize(model.Shoot(frame++, scene, Targets::kAll));
}
#define ETUDE_EFFECT(name, ...) \
  BENCHMARK_CAPTURE(Effect, name, CameraEffects __VA_ARGS__)->Unit(benchmark::kMillisecond)
ETUDE_EFFECT(none, {.noise = 0});
ETUDE_EFFECT(noise, {.noise = 1});
ETUDE_EFFECT(rolling_shutter, {.rolling_shutter_ms = 20, .noise = 0});
ETUDE_EFFECT(distortion, {.radial_distortion = -0.06, .noise = 0});
ETUDE_EFFECT(defocus_1px, {.defocus_px = 1, .noise = 0});
ETUDE_EFFECT(vignette, {.vignette = 1, .noise = 0});
ETUDE_EFFECT(dust, {.dust = 0.5, .noise = 0});
ETUDE_EFFECT(exposure, {.exposure_ev = 0.5, .noise = 0});
ETUDE_EFFECT(white_balance, {.white_balance_ev = 0.5, .noise = 0});
ETUDE_EFFECT(noise_of_light, {.exposure_ev = 0.5, .noise = 1});
ETUDE_EFFECT(bayer, {.bayer = 1, .noise = 0});
ETUDE_EFFECT(bayer_and_noise, {.bayer = 1, .noise = 1});
ETUDE_EFFECT(jpeg, {.noise = 0, .jpeg_loss = 20});
ETUDE_EFFECT(motion_blur, {.motion_blur = 0.5, .noise = 0});
BENCHMARK_CAPTURE(Effect, all_but_motion_blur, kAll)->Unit(benchmark::kMillisecond);

// Times a picture of a take, with drawing.
void Shot(benchmark::State& state, const CameraEffects& effects) {
  const auto renderer = Renderer::Create();
  if (!renderer) return state.SkipWithError(renderer.error().message.c_str());
  CameraModel model(CameraWith(effects), effects, 30, {kWorld, "camera", true});
  const std::vector<Figure> figures{{BodyCapsules(StandingPose()), PerformerColours()}};
  const auto scene = [&](double, const RowRange& rows, Targets targets) {
    return (*renderer)->RenderRows({}, figures, model.pinhole(), targets, rows);
  };
  std::size_t frame = 0;
  model.Shoot(frame++, scene, Targets::kAll);  // the first picture compiles the shaders
  for (auto _ : state) benchmark::DoNotOptimize(model.Shoot(frame++, scene, Targets::kAll));
}
BENCHMARK_CAPTURE(Shot, noise, CameraEffects{.noise = 1})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Shot, all_but_motion_blur, kAll)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace etude
