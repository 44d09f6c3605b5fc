// Times a picture of the empty room, of a person made of capsules, and of a character with some thousand triangles.
#include <benchmark/benchmark.h>

#include "sim/character/characters.h"
#include "sim/character/posed.h"
#include "sim/choreography/canonical_body.h"
#include "sim/render/renderer.h"
#include "sim/stage/stage.h"

namespace etude {
namespace {

constexpr Intrinsics kVga{};

std::vector<Figure> Nobody() { return {}; }
std::vector<Figure> OfCapsules() { return {{BodyCapsules(StandingPose()), PerformerColours()}}; }
std::vector<Figure> OfSurfaces() { return {PosedFigure(BearCharacter(), StandingPose())}; }

// Reports wall-clock time, because GL may use threads outside the pinned environment.
void InMilliseconds(benchmark::internal::Benchmark* benchmark) {
  benchmark->Unit(benchmark::kMillisecond)->UseRealTime();
}

enum class Kind { kColour, kLabels, kAll };

void Picture(benchmark::State& state, std::vector<Figure> (*make)(), const Intrinsics& intrinsics, Kind kind) {
  const auto renderer = Renderer::Create();
  if (!renderer) return state.SkipWithError(renderer.error().message.c_str());
  const std::vector<Figure> figures = make();
  const Camera camera = LookAt(intrinsics, {-1.2, 1.4, 3.9}, {0, 0.95, 0});
  const auto draw = [&] {
    const Targets targets = kind == Kind::kAll      ? Targets::kAll
                            : kind == Kind::kLabels ? Targets::kColourAndLabels
                                                    : Targets::kColour;
    benchmark::DoNotOptimize((*renderer)->Render({}, figures, camera, targets));
  };
  draw();  // the first picture compiles the shaders
  for (auto _ : state) draw();
}
BENCHMARK_CAPTURE(Picture, room_vga, Nobody, kVga, Kind::kColour)->Apply(InMilliseconds);
BENCHMARK_CAPTURE(Picture, capsules_vga, OfCapsules, kVga, Kind::kColour)->Apply(InMilliseconds);
BENCHMARK_CAPTURE(Picture, capsules_vga_all, OfCapsules, kVga, Kind::kAll)->Apply(InMilliseconds);
BENCHMARK_CAPTURE(Picture, capsules_vga_labels, OfCapsules, kVga, Kind::kLabels)->Apply(InMilliseconds);
BENCHMARK_CAPTURE(Picture, surfaces_vga, OfSurfaces, kVga, Kind::kColour)->Apply(InMilliseconds);
BENCHMARK_CAPTURE(Picture, surfaces_vga_all, OfSurfaces, kVga, Kind::kAll)->Apply(InMilliseconds);

// Times a picture of the capture task. People and moving objects are posed anew for each picture. The argument is the
// condition `scene` in per cent.
void Staged(benchmark::State& state) {
  const auto renderer = Renderer::Create();
  if (!renderer) return state.SkipWithError(renderer.error().message.c_str());
  const BodyPose pose = StandingPose();
  const std::vector<Camera> cameras = {LookAt(kVga, {-2.4, 1.0, 2.9}, {0, 0.95, 0})};
  const StagedRoom stage({.seed = 3, .scene = 0.01 * static_cast<double>(state.range(0))}, {&pose, 1}, cameras);
  double seconds = 0;
  const auto draw = [&] {
    std::vector<Figure> figures = stage.MoversAt(seconds);
    figures.push_back(stage.PerformerAt(pose, PerformerColours()));
    const Room room{.brightness = stage.FlickerAt(seconds), .interior = stage.interior()};
    benchmark::DoNotOptimize((*renderer)->Render(room, figures, cameras[0], Targets::kColourAndLabels));
    seconds += 1 / 30.0;
  };
  draw();
  for (auto _ : state) draw();
}
BENCHMARK(Staged)->Apply(InMilliseconds)->Arg(0)->Arg(25)->Arg(50)->Arg(75)->Arg(100);

void Pose(benchmark::State& state) {
  const Character bear = BearCharacter();
  const BodyPose pose = StandingPose();
  for (auto _ : state) benchmark::DoNotOptimize(PosedFigure(bear, pose));
}
BENCHMARK(Pose)->Apply(InMilliseconds);

}  // namespace
}  // namespace etude
