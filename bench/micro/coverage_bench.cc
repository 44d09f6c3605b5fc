// Times the computations of `etude bridge` on a library, without reading its files: tags, keys of in-betweens, and the
// coverage of transitions into any other clip, for 10⁴ to 10⁶ frames. It also times the coverage of all pairs of clips,
// for sizes at which that is affordable. The library is made of performances with varied tempo and amplitude
// (tests/sim/choreography/varied_library.h). Arguments that are not options name the clips to vary.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "bench/micro/seeds.h"
#include "engine/transitions/library/coverage.h"
#include "engine/transitions/library/in_betweens.h"
#include "engine/transitions/library/library.h"
#include "tests/sim/choreography/varied_library.h"

namespace etude {
namespace {

/// Returns tagged clips of about six seconds with `frames` frames in total.
std::vector<TaggedClip> MakeTagged(const std::vector<BodyMotion>& seeds, int frames) {
  constexpr std::size_t kClipFrames = 171;  // frames per clip: 5.7 s at 30 Hz
  RandomStream dice({.suite_seed = 1, .scenario = "coverage_bench", .trial = 0}, "library");
  std::vector<BodyMotion> clips;
  for (const BodyMotion& performance : VariedLibrary(seeds, frames, dice)) {
    for (std::size_t first = 0; first < performance.poses.size(); first += kClipFrames) {
      const auto begin = performance.poses.begin() + static_cast<std::ptrdiff_t>(first);
      const std::size_t count = std::min(kClipFrames, performance.poses.size() - first);
      clips.push_back({.rate_hz = performance.rate_hz, .poses = {begin, begin + static_cast<std::ptrdiff_t>(count)}});
    }
  }
  const BodyPose& dancer = seeds.front().poses.front();
  const BodyProportions proportions = MakeBodyProportions(dancer, StandingHipHeight(dancer));
  PerformBy(proportions, clips);
  return TagClips(clips, proportions.standing_hip_height);
}

class Libraries {
 public:
  explicit Libraries(const std::vector<std::string>& files) {
    for (SeedClip& seed : LoadSeeds(files)) seeds_.push_back(std::move(seed.motion));
  }
  /// Returns the tagged library of `frames` frames. Keeps it until another size is requested.
  const std::vector<TaggedClip>& Of(int frames) {
    if (frames != frames_) tagged_ = MakeTagged(seeds_, frames);
    frames_ = frames;
    return tagged_;
  }

 private:
  std::vector<BodyMotion> seeds_;
  std::vector<TaggedClip> tagged_;
  int frames_ = 0;
};

void RegisterAll(Libraries& libraries) {
  for (const int frames : {10'000, 40'000, 160'000, 1'000'000}) {
    const auto add = [&](const char* name, auto work) {
      const std::string full_name = name + ("/" + std::to_string(frames));
      benchmark::RegisterBenchmark(full_name.c_str(), [=, &libraries](benchmark::State& state) {
        const std::vector<TaggedClip>& clips = libraries.Of(frames);
        for (auto _ : state) benchmark::DoNotOptimize(work(clips));
        state.counters["clips"] = static_cast<double>(clips.size());
      })->Unit(benchmark::kMillisecond);
    };
    add("keys", [](const std::vector<TaggedClip>& clips) { return BuildInBetweens(clips).keys.size(); });
    add("any", [](const std::vector<TaggedClip>& clips) {
      return Coverage(clips, {}, {.with_pairs = false}).IntoAny(0).frame_share;
    });
    if (frames > 40'000) continue;
    add("pairs", [](const std::vector<TaggedClip>& clips) { return Coverage(clips, {}).Of(0, 1).frame_share; });
  }
}

}  // namespace
}  // namespace etude

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  etude::Libraries libraries({argv + 1, argv + argc});
  etude::RegisterAll(libraries);
  benchmark::RunSpecifiedBenchmarks();
}
