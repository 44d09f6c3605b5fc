// Times the pictures of `capsules_vga_labels` in bench/micro/render_bench, drawn by OSMesa or EGL without Etude's
// renderer.
#include <benchmark/benchmark.h>

#include "bench/peers/bare_draw.h"
#include "sim/body/shape.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

void Bare(benchmark::State& state) {
  const Camera camera = LookAt(Intrinsics{}, {-1.2, 1.4, 3.9}, {0, 0.95, 0});
  const auto bare = BareDraw::Create({}, camera);
  if (!bare) return state.SkipWithError(bare.error().message.c_str());
  const std::vector<Figure> figures = {{BodyCapsules(StandingPose()), PerformerColours()}};
  (*bare)->Draw(figures);
  for (auto _ : state) (*bare)->Draw(figures);
}
BENCHMARK(Bare)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace etude
