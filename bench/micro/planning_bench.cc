// Times the planning of one transition by every choice, with clips of 1,000 frames (33 s) and an allowed wait of one
// second. The point-cloud choice is also timed in the form of its paper, which computes the distance of every pair of
// frames. Before measuring, the program checks that both forms of the point-cloud choice find the same frames.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "bench/micro/seeds.h"
#include "engine/fuzzy/features.h"
#include "engine/transitions/choices/choice.h"
#include "engine/transitions/choices/matching.h"
#include "engine/transitions/choices/pair_rows.h"
#include "tests/sim/choreography/varied_library.h"

namespace etude {
namespace {

MotionLibrary MakeClips() {
  constexpr int kClips = 8, kLength = 1000;
  std::vector<BodyMotion> seeds;
  for (SeedClip& seed : LoadSeeds({})) seeds.push_back(std::move(seed.motion));
  RandomStream dice({.suite_seed = 1, .scenario = "planning_bench", .trial = 0}, "library");
  std::vector<BodyMotion> clips(1);
  for (const BodyMotion& part : VariedLibrary(seeds, kClips * kLength, dice)) {
    for (const BodyPose& pose : part.poses) {
      if (clips.back().poses.size() == kLength) clips.emplace_back();
      clips.back().poses.push_back(pose);
    }
  }
  const BodyPose& dancer = seeds.front().poses.front();
  return MakeLibrary(std::vector<std::string>(clips.size(), "clip"), clips,
                     MakeBodyProportions(dancer, StandingHipHeight(dancer)));
}

std::vector<TransitionRequest> Requests(const MotionLibrary& library) {
  std::vector<TransitionRequest> requests;
  const int clips = static_cast<int>(library.motions.size());
  for (int from = 0; from < clips; ++from) {
    requests.push_back({.from = from, .request_frame = 100 * from, .to = (from + 1) % clips});
  }
  return requests;
}

/// Returns the distance of one pair of frames by Kovar's closed form, over all points of both point clouds,
/// centimetres.
double CloudDistance(const BodyMotion& a, int frame_a, const BodyMotion& b, int frame_b, int half) {
  const Reach reach =
      ReachAround(frame_a, static_cast<int>(a.poses.size()), frame_b, static_cast<int>(b.poses.size()), half);
  const double share = 1.0 / (static_cast<double>(kRoleCount) * reach.Count());
  glm::dvec3 mean_a(0), mean_b(0);
  const auto for_each_pair = [&](auto visit) {
    for (int i = -reach.before; i <= reach.after; ++i) {
      const BodyPose &pose_a = a.poses[frame_a + i], &pose_b = b.poses[frame_b + i];
      for (std::size_t j = 0; j < kRoleCount; ++j) visit(pose_a.joints[j], pose_b.joints[j]);
    }
  };
  for_each_pair([&](const glm::dvec3& p, const glm::dvec3& q) {
    mean_a += p * share;
    mean_b += q * share;
  });
  mean_a.y = mean_b.y = 0;
  double along = 0, across = 0, rest = 0;
  for_each_pair([&](const glm::dvec3& point_a, const glm::dvec3& point_b) {
    const glm::dvec3 p = point_a - mean_a, q = point_b - mean_b;
    along += p.x * q.x + p.z * q.z;
    across += p.x * q.z - p.z * q.x;
    rest += glm::dot(p, p) + glm::dot(q, q) - 2 * p.y * q.y;
  });
  return 100 * std::sqrt(std::max(rest - 2 * std::sqrt(along * along + across * across), 0.0) * share);
}

struct Pair {
  int from = 0, to = 0;
};

Pair NearestPairByPair(const MotionLibrary& library, const TransitionRequest& request) {
  const BodyMotion &playing = library.motions[request.from], &next = library.motions[request.to];
  const PointCloudOptions options;
  const AllowedFrames allowed = AllowedAnyFrames(library, request, options.least_play_s);
  const int half = static_cast<int>(std::lround(0.5 * options.window_s * playing.rate_hz));
  Pair best;
  double least = std::numeric_limits<double>::infinity();
  for (int from : allowed.leave) {
    for (int to : allowed.enter) {
      const double distance = CloudDistance(playing, from, next, to, half);
      if (distance >= least) continue;
      least = distance;
      best = {from, to};
    }
  }
  return best;
}

void CompareAnswers(const MotionLibrary& library) {
  for (const TransitionRequest& request : Requests(library)) {
    const TransitionRecord record = FindChoice("point-cloud")->plan(library, request, {}, {});
    const Pair pair = NearestPairByPair(library, request);
    if (record.segments.front().last == pair.from && record.segments.back().first == pair.to) continue;
    std::fprintf(stderr, "pair by pair, other frames are nearest than in rows\n");
    std::exit(1);
  }
}

/// Registers a benchmark that plans all transitions in turn. The reported time is the mean over all transitions.
void RegisterPlanning(const MotionLibrary& library, const std::string& name, auto plan) {
  benchmark::RegisterBenchmark(("plan/" + name).c_str(), [=, &library](benchmark::State& state) {
    const std::vector<TransitionRequest> requests = Requests(library);
    while (state.KeepRunningBatch(static_cast<std::int64_t>(requests.size()))) {
      for (const TransitionRequest& request : requests) benchmark::DoNotOptimize(plan(library, request));
    }
  })->Unit(benchmark::kMicrosecond);
}

}  // namespace
}  // namespace etude

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const etude::MotionLibrary library = etude::MakeClips();
  etude::CompareAnswers(library);
  for (const etude::Choice& choice : etude::AllChoices()) {
    etude::RegisterPlanning(library, choice.name, [&](const auto& clips, const auto& request) {
      return choice.plan(clips, request, {}, {});
    });
  }
  etude::RegisterPlanning(library, "point-cloud, pair by pair", etude::NearestPairByPair);
  benchmark::RunSpecifiedBenchmarks();
}
