// Times a crowd of characters with one body (`etude crowd`) on one core, for every SIMD target, in double and float. It
// prints the time of a frame and the number of characters that can be computed in 1/60 s.
//
//     crowd_bench [--characters=1000] [--frames=120]
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <string_view>

#include "bench/tasks/tracking/crowd.h"
#include "engine/base/text.h"
#include "engine/kinematics/solvers/gauss_newton.h"
#include "engine/kinematics/solvers/gauss_newton_plain.h"

namespace etude {
namespace {

constexpr int kMaxSteps = 100;  // per frame, as in etude crowd

double ThreadTimeMs() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

void Measure(std::span<const TrackingWorld> worlds, int frames, const std::string& target, Precision precision) {
  SetBatchTarget(target);
  Crowd crowd(worlds);
  IkOptions options;
  options.max_iterations = kMaxSteps;
  std::vector<double> times;
  std::int64_t met = 0, steps = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const double begin = ThreadTimeMs();
    const Crowd::Followed followed = crowd.FollowNext(options, precision);
    times.push_back(ThreadTimeMs() - begin);
    met += followed.met;
    steps += followed.steps;
  }
  SetBatchTarget("");
  const double first = times[0];
  std::sort(times.begin() + 1, times.end());
  const double median = times[times.size() / 2], slowest = times.back();
  const auto count = static_cast<double>(worlds.size());
  fmt::print("| {} | {} | {:.2f} % | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.0f} |\n", target,
             precision == Precision::kFloat ? "float" : "double", 100.0 * static_cast<double>(met) / (count * frames),
             static_cast<double>(steps) / (count * frames), first, median, slowest,
             count * 1000 / CrowdOptions().rate_hz / slowest);
}

bool Read(std::string_view argument, std::string_view key, int& number) {
  if (!argument.starts_with(key)) return false;
  argument.remove_prefix(key.size());
  number = ParseNumber<int>(argument).value_or(0);
  return number >= kMinTrackedFrames;
}

int Run(std::span<char* const> arguments) {
  CrowdOptions crowd;
  for (const std::string_view argument : arguments) {
    if (!Read(argument, "--characters=", crowd.characters) && !Read(argument, "--frames=", crowd.frames)) {
      fmt::print(stderr, "crowd_bench: {}: only --characters=N, --frames=N (4 or more)\n", argument);
      return 2;
    }
  }
  const auto worlds = MakeCrowd(crowd);
  if (!worlds) {
    fmt::print(stderr, "{}\n", ToString(worlds.error()));
    return 2;
  }
  fmt::print("{} characters, {} frames at {} Hz, one thread\n\n", crowd.characters, crowd.frames, crowd.rate_hz);
  fmt::print(
      "| vectors | | frames solved | steps | first frame, ms | median, ms | slowest, ms | characters at 60 Hz |\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  for (const std::string& target : BatchTargets()) {
    for (const Precision precision : {Precision::kDouble, Precision::kFloat})
      Measure(*worlds, crowd.frames, target, precision);
  }
  return 0;
}

}  // namespace
}  // namespace etude

int main(int argc, char** argv) { return etude::Run({argv + 1, argv + argc}); }
