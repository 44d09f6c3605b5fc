// Times the simulated annotator on one picture: seeing it, marking it, and drawing and reading the marks.
#include <benchmark/benchmark.h>

#include "engine/vision/strokes.h"
#include "sim/annotator/annotator.h"
#include "sim/annotator/drawing.h"
#include "sim/choreography/canonical_body.h"
#include "sim/render/renderer.h"

namespace etude {
namespace {

struct Shot {
  View view;
  Mask whole, none;
  AnnotatedPicture picture(const Mask& person) const { return {view.labels, view.colour, person}; }
};

const Shot& StandingShot() {
  static const Shot kShot = [] {
    const auto renderer = Renderer::Create();
    const Camera camera = LookAt({}, {-1.2, 1.4, 3.9}, {0, 0.95, 0});
    Shot shot;
    shot.view = (*renderer)->Render({}, {{BodyCapsules(StandingPose()), PerformerColours()}}, camera, Targets::kAll);
    shot.whole = shot.none = Mask(640, 480);
    for (std::size_t i = 0; i < shot.whole.pixels.size(); ++i) {
      shot.whole.pixels[i] = IsPerformer(shot.view.labels.pixels[i]);
    }
    return shot;
  }();
  return kShot;
}

void See(benchmark::State& state) {
  const Shot& shot = StandingShot();
  const Mask& person = state.range(0) != 0 ? shot.whole : shot.none;
  for (auto _ : state) benchmark::DoNotOptimize(SeePicture(shot.picture(person)));
}
BENCHMARK(See)->ArgName("extracted")->Arg(1)->Arg(0)->Unit(benchmark::kMillisecond);

void Mark(benchmark::State& state) {
  const Shot& shot = StandingShot();
  Annotator annotator({}, {}, {.suite_seed = 1, .scenario = "bench", .trial = 0}, 0, 0);
  int frame = 0;
  for (auto _ : state) benchmark::DoNotOptimize(annotator.Mark(frame++, shot.picture(shot.whole)));
}
BENCHMARK(Mark)->Unit(benchmark::kMillisecond);

void DrawAndRead(benchmark::State& state) {
  const Shot& shot = StandingShot();
  Annotator annotator({}, {}, {.suite_seed = 1, .scenario = "bench", .trial = 0}, 0, 0);
  const Marks marks = annotator.Mark(0, shot.picture(shot.whole));
  for (auto _ : state) benchmark::DoNotOptimize(ReadMarks(DrawMarks(marks, 640, 480)));
}
BENCHMARK(DrawAndRead)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace etude
