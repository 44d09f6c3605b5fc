// Times one frame of each recogniser, and one frame of filter and features. A recogniser follows all eleven built-in
// moves, one of which is requested.
//   build/release/bench/micro/recognition_bench --benchmark_repetitions=5 --benchmark_report_aggregates_only=true
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "engine/recognition/recognisers.h"
#include "engine/recognition/sight.h"
#include "sim/choreography/move.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

struct Dances {
  std::vector<TaughtMove> taught;
  SkeletonStream stream;  ///< a stream of all moves, one after the other, with noise of 1 cm
};

const Dances& AllDances() {
  static const Dances dances = [] {
    Dances made;
    RandomStream dice({.suite_seed = 1, .scenario = "recognition-bench", .trial = 0}, "joint-noise");
    for (const std::string& name : BuiltinMoveNames()) {
      const Move move = *LoadBuiltinMove(name);
      TaughtMove& taught = made.taught.emplace_back();
      taught.name = name;
      taught.span_s = move.motion.DurationSeconds() + 0.5;
      taught.examples = {StreamOf(move.motion)};
      for (const KeyPose& key_pose : move.key_poses) {
        TaughtPose& pose = taught.poses.emplace_back();
        for (const KeyPose::Target& target : key_pose.targets) {
          pose.targets.push_back({*FindFeature(target.feature), target.degrees, target.tolerance_deg});
        }
      }
      for (SensedFrame frame : taught.examples.front().frames) {
        for (SensedJoint& joint : frame.joints) joint.position += 0.01 * dice.Normal3();
        made.stream.frames.push_back(frame);
      }
    }
    return made;
  }();
  return dances;
}

void Follow(benchmark::State& state, const RecogniserKind* kind) {
  const Dances& dances = AllDances();
  const auto recogniser = MakeRecogniser({.kind = kind}, dances.taught);
  if (!recogniser) return state.SkipWithError(recogniser.error().message.c_str());
  const SeenStream seen = SeeStream(dances.stream, {});
  const auto follower = (*recogniser)->Follow(dances.stream.rate_hz);
  std::size_t frame = 0;
  constexpr std::size_t kWindow = 120;  // number of frames for which a move is requested
  for (auto _ : state) {
    if (frame % kWindow == 0) follower->Ask(frame / kWindow % dances.taught.size());
    benchmark::DoNotOptimize(follower->Update(seen[frame % seen.frames.size()]).asked);
    ++frame;
  }
}

void See(benchmark::State& state) {
  const SkeletonStream& stream = AllDances().stream;
  LiveSight sight({.kind = FilterKind::kHolt}, stream.rate_hz);
  std::size_t frame = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(sight.Update(stream.frames[frame % stream.frames.size()]).features.body_seen);
    ++frame;
  }
}

[[maybe_unused]] const bool kRegistered = [] {
  benchmark::RegisterBenchmark("see", See)->Unit(benchmark::kMicrosecond);
  for (const RecogniserKind& kind : AllRecognisers()) {
    benchmark::RegisterBenchmark(kind.name.c_str(), Follow, &kind)->Unit(benchmark::kMicrosecond);
  }
  return true;
}();

}  // namespace
}  // namespace etude
