// A crowd of one body on one core: every character follows a motion of its own at 60 Hz, each frame from its last
// frame's answer, within the joints' limits: the task `tracking` for all of them at once, by batches of gauss-newton.
// Says how long a frame takes and how many characters 1/60 s is enough for; with a folder, it leaves every second frame
// of the crowd there as a picture instead.
//
//     crowd_bench [--characters=1000] [--frames=120] [--pictures=FOLDER]
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <string_view>

#include "bench/clips/builtin_clip.h"
#include "bench/clips/clip_library.h"
#include "bench/tasks/tracking/world.h"
#include "engine/cameras/camera.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/gauss_newton_batch.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/tree_to_body.h"
#include "sim/body/shape.h"
#include "sim/choreography/move.h"
#include "sim/render/renderer.h"
#include "sim/sensors/image_files.h"

namespace etude {
namespace {

constexpr double kRateHz = 60;
constexpr int kMostSteps = 20;  // a frame: what task tracking allows

double ThreadTimeMs() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

template <class Value>
Value OrExit(Result<Value> result) {
  if (!result) {
    fmt::print(stderr, "{}\n", ToString(result.error()));
    std::exit(2);
  }
  return *std::move(result);
}

// Windows of the built-in motions, which one body performs; so all have one tree.
std::vector<TrackingWorld> MakeCrowd(int characters, int frames) {
  std::vector<std::string> references;
  for (const std::string& name : BuiltinMoveNames()) references.push_back(std::string(kBuiltinPrefix) + name);
  for (const std::string& name : BuiltinActNames()) references.push_back(std::string(kBuiltinPrefix) + name);
  const ClipLibrary library = OrExit(LoadClips(references, {}));
  const TrackingOptions options{.duration_s = frames / kRateHz, .rate_hz = kRateHz};
  std::vector<TrackingWorld> crowd;
  for (int trial = 0; static_cast<int>(crowd.size()) < characters && trial < 4 * characters; ++trial) {
    const LibraryClip& clip = library.clips[static_cast<std::size_t>(trial) % library.clips.size()];
    auto world = MakeTrackingWorld(options, clip, {.suite_seed = 1, .scenario = "crowd", .trial = trial});
    if (world && static_cast<int>(world->truth.size()) == frames) crowd.push_back(*std::move(world));
  }
  if (static_cast<int>(crowd.size()) < characters) {
    fmt::print(stderr, "crowd_bench: only {} motions of {} frames\n", crowd.size(), frames);
    std::exit(2);
  }
  return crowd;
}

/// The crowd on its way from frame to frame.
class Crowd {
 public:
  explicit Crowd(std::span<const TrackingWorld> worlds)
      : worlds_(worlds), tree_(worlds[0].tree), batch_(tree_, static_cast<int>(worlds.size())) {
    for (std::size_t i = 0; i < worlds.size(); ++i) {
      IkProblem problem{worlds[i].truth[0], worlds[i].targets[0], tree_.limits};
      problem.start.angles = worlds[i].first_angles;
      batch_.Set(static_cast<int>(i), problem);
    }
  }

  /// Follows everybody to `frame`. Returns how many have met their targets.
  int Follow(std::size_t frame, const IkOptions& options, Precision precision) {
    for (std::size_t i = 0; i < worlds_.size(); ++i) {
      const TreeState& state = worlds_[i].truth[frame];
      for (int k = 0; k < 3; ++k) batch_.root(k)[i] = state.root_position[k];
      for (int k = 0; k < 9; ++k) batch_.root(3 + k)[i] = state.root_frame[k / 3][k % 3];
      for (int e = 0; e < static_cast<int>(tree_.effectors.size()); ++e) {
        const EffectorTarget& target = worlds_[i].targets[frame][e];
        for (int k = 0; k < 3; ++k) batch_.target(e, k)[i] = target.position[k];
        for (int k = 0; k < 9; ++k) batch_.target(e, 3 + k)[i] = target.axes[k / 3][k % 3];
      }
    }
    const IkBatchSolution solution = SolveGaussNewtonBatch(tree_, batch_, options, precision);
    for (int d = 0; d < tree_.dof_count(); ++d)
      std::ranges::copy(solution.angles_of(d), batch_.start_angles(d).begin());
    for (const int count : solution.iterations) steps_ += count;
    return static_cast<int>(std::ranges::count(solution.statuses, IkStatus::kConverged));
  }

  std::int64_t steps() const { return steps_; }
  TreeState StateOf(std::size_t i, std::size_t frame) const {
    TreeState state = worlds_[i].truth[frame];
    for (int d = 0; d < tree_.dof_count(); ++d) state.angles[d] = batch_.start_angles(d)[i];
    return state;
  }

 private:
  const std::span<const TrackingWorld> worlds_;
  const KinematicTree& tree_;
  IkBatch batch_;
  std::int64_t steps_ = 0;
};

void Measure(std::span<const TrackingWorld> worlds, int frames, const std::string& target, Precision precision) {
  SetBatchTarget(target);
  Crowd crowd(worlds);
  IkOptions options;
  options.max_iterations = kMostSteps;
  std::vector<double> times;
  std::int64_t solved = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const double begin = ThreadTimeMs();
    solved += crowd.Follow(static_cast<std::size_t>(frame), options, precision);
    times.push_back(ThreadTimeMs() - begin);
  }
  SetBatchTarget("");
  const double first = times[0];
  std::sort(times.begin() + 1, times.end());
  const double median = times[times.size() / 2], slowest = times.back();
  const double count = static_cast<double>(worlds.size());
  fmt::print(
      "| {} | {} | {:.2f} % | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.0f} |\n", target,
      precision == Precision::kFloat ? "float" : "double", 100.0 * static_cast<double>(solved) / (count * frames),
      static_cast<double>(crowd.steps()) / (count * frames), first, median, slowest, count * 1000 / kRateHz / slowest);
}

// On a square, the first row nearest to the camera.
glm::dvec3 PlaceOf(std::size_t i, std::size_t count) {
  constexpr double kApart = 1.6;  // metres
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  const double across = static_cast<double>(i % side) - 0.5 * static_cast<double>(side - 1);
  return {kApart * across, 0, kApart * static_cast<double>(i / side)};
}

void Film(std::span<const TrackingWorld> worlds, int frames, const std::string& folder) {
  const auto renderer = OrExit(Renderer::Create());
  Crowd crowd(worlds);
  IkOptions options;
  options.max_iterations = kMostSteps;
  const double depth = PlaceOf(worlds.size() - 1, worlds.size()).z;
  const Intrinsics hd{.width = 1280, .height = 720, .fx = 1100, .fy = 1100, .cx = 640, .cy = 360};
  const Camera camera = LookAt(hd, {0, 0.28 * depth + 2, 1.45 * depth + 4}, {0, 0, 0.45 * depth});
  for (int frame = 0; frame < frames; ++frame) {
    crowd.Follow(static_cast<std::size_t>(frame), options, Precision::kFloat);
    if (frame % 2 != 0) continue;
    std::vector<Figure> figures;
    for (std::size_t i = 0; i < worlds.size(); ++i) {
      const glm::dvec3 place = PlaceOf(i, worlds.size());
      Figure figure{BodyCapsules(ToBodyPose(worlds[0].tree, crowd.StateOf(i, static_cast<std::size_t>(frame)))),
                    PerformerColours()};
      for (Capsule& capsule : figure.shape) {
        capsule.a += place;
        capsule.b += place;
      }
      figures.push_back(std::move(figure));
    }
    const std::string path = fmt::format("{}/{:04}.png", folder, frame / 2);
    const auto saved =
        SavePng(renderer->Render({.casts_shadows = false}, figures, camera, Targets::kColour).colour, path);
    if (!saved) {
      fmt::print(stderr, "{}\n", ToString(saved.error()));
      std::exit(2);
    }
  }
}

bool Read(std::string_view argument, std::string_view key, int& number) {
  if (!argument.starts_with(key)) return false;
  argument.remove_prefix(key.size());
  const auto [end, error] = std::from_chars(argument.data(), argument.data() + argument.size(), number);
  return error == std::errc() && end == argument.data() + argument.size() && number >= kFewestTrackedFrames;
}

int Run(std::span<char* const> arguments) {
  int characters = 1000, frames = 120;
  std::string pictures;
  for (const std::string_view argument : arguments) {
    if (argument.starts_with("--pictures=")) {
      pictures = argument.substr(11);
    } else if (!Read(argument, "--characters=", characters) && !Read(argument, "--frames=", frames)) {
      fmt::print(stderr, "crowd_bench: {}: only --characters=N, --frames=N (4 or more), --pictures=FOLDER\n", argument);
      return 2;
    }
  }
  const std::vector<TrackingWorld> worlds = MakeCrowd(characters, frames);
  if (!pictures.empty()) {
    Film(worlds, frames, pictures);
    return 0;
  }
  fmt::print("{} characters, {} frames at {} Hz, one thread\n\n", characters, frames, kRateHz);
  fmt::print(
      "| vectors | | frames solved | steps | first frame, ms | median, ms | slowest, ms | characters at 60 Hz |\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  for (const std::string& target : BatchTargets()) {
    for (const Precision precision : {Precision::kDouble, Precision::kFloat})
      Measure(worlds, frames, target, precision);
  }
  return 0;
}

}  // namespace
}  // namespace etude

int main(int argc, char** argv) { return etude::Run({argv + 1, argv + argc}); }
