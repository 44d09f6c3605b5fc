#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "bench/tasks/tracking/crowd.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/progress_bar.h"
#include "engine/kinematics/body_tree.h"
#include "io/files/files.h"
#include "tools/clips/crowd_stage.h"

namespace etude {
namespace {

struct CrowdCommandOptions {
  CrowdOptions crowd;
  double seconds = 2;
  int steps = 100;  ///< maximum number of solver iterations per character and frame
  /// Solves in floats. A problem that floats do not solve is solved again in doubles, with up to `steps` further
  /// iterations.
  bool in_float = false;
  std::string output;  ///< the film to write; "" = only the report
  int jobs = 0;
  bool overwrite = false, as_json = false;
};

constexpr int kWidth = 1280, kHeight = 720;
constexpr double kFilmRateHz = 30;  // upper limit of the film's frame rate, Hz; at 60 Hz every second frame is shown

double ProcessorTimeMs() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Timings {
  std::int64_t met = 0, steps = 0;
  std::vector<double> times_ms;  ///< processing time of each frame
};

/// Prints the measured times, and returns the times as JSON.
Json Tell(const CrowdCommandOptions& options, Timings timings) {
  const double count = static_cast<double>(options.crowd.characters) * options.crowd.frames;
  fmt::print("{} characters, {} frames at {:g} Hz, gauss-newton in batches of {}\n", options.crowd.characters,
             options.crowd.frames, options.crowd.rate_hz, options.in_float ? "floats" : "doubles");
  fmt::print("{:.2f} % of all poses reach their targets; the mean number of solver steps is {:.2f}\n",
             100 * static_cast<double>(timings.met) / count, static_cast<double>(timings.steps) / count);
  const double first = timings.times_ms.front();
  std::sort(timings.times_ms.begin() + 1, timings.times_ms.end());
  const auto at = [&](double share) {
    return timings.times_ms[1 + static_cast<std::size_t>(share * static_cast<double>(timings.times_ms.size() - 2))];
  };
  fmt::print(
      "ms per frame on one core (the frame rate allows {:.1f}): median {:.2f}, p99 {:.2f}, largest {:.2f}; the first "
      "frame starts from the standing pose and takes {:.2f}\n",
      1000 / options.crowd.rate_hz, at(0.5), at(0.99), timings.times_ms.back(), first);
  return {{"characters", options.crowd.characters},
          {"frames", options.crowd.frames},
          {"rate_hz", options.crowd.rate_hz},
          {"met_share", static_cast<double>(timings.met) / count},
          {"steps", static_cast<double>(timings.steps) / count},
          {"start_ms", first},
          {"median_ms", at(0.5)},
          {"p99_ms", at(0.99)},
          {"largest_ms", timings.times_ms.back()}};
}

/// A crowd whose characters follow their target motions, solved frame by frame, and the measured processing times.
class FollowedCrowd {
 public:
  FollowedCrowd(const CrowdCommandOptions& options, std::span<const TrackingWorld> worlds)
      : tree_(worlds[0].tree), crowd_(worlds), precision_(options.in_float ? Precision::kFloat : Precision::kDouble) {
    ik_.max_iterations = options.steps;
  }

  /// Solves the poses of all characters up to a frame. Call it with ascending frames.
  void FollowTo(int frame) {
    for (; next_ <= frame; ++next_) {
      const double begin = ProcessorTimeMs();
      const auto [met, steps] = crowd_.FollowNext(ik_, precision_);
      timings_.times_ms.push_back(ProcessorTimeMs() - begin);
      timings_.met += met;
      timings_.steps += steps;
    }
  }
  CrowdStage::Character At(std::size_t character) const {
    return {ToBodyPose(tree_, crowd_.StateOf(character)), !crowd_.HasMet(character)};
  }

  const Timings& timings() const { return timings_; }

 private:
  const KinematicTree& tree_;
  Crowd crowd_;
  Precision precision_;
  IkOptions ik_;
  Timings timings_;
  int next_ = 0;
};

/// Makes a film of every n-th frame while the poses are solved. Returns false if the film was stopped.
Result<bool> FilmCrowd(const CrowdCommandOptions& options, FollowedCrowd& followed, const FilmWatch& watch) {
  using Character = CrowdStage::Character;
  static_assert(std::is_trivially_copyable_v<Character>, "characters are passed on as they are stored in memory");
  ASSIGN_OR_RETURN(auto* const renderer, SharedRenderer());
  CrowdStage stage(options.crowd.characters, kWidth, kHeight, *renderer);
  // Choose every n-th frame, so that the film shows at most kFilmRateHz frames per second.
  const double rate_hz = options.crowd.rate_hz;
  const int every = std::max(1, static_cast<int>(std::ceil(rate_hz / kFilmRateHz)));
  const int frames = (options.crowd.frames + every - 1) / every;
  const auto count = static_cast<std::size_t>(options.crowd.characters);
  // This process solves the poses; copies of this process draw the frames.
  const auto fill = [&](int frame, std::span<std::uint8_t> into) -> Result<void> {
    followed.FollowTo(frame * every);
    for (std::size_t i = 0; i < count; ++i) {
      const Character character = followed.At(i);
      std::memcpy(&into[i * sizeof character], &character, sizeof character);
    }
    return {};
  };
  const auto draw = [&](int frame, std::span<const std::uint8_t> fed) {
    std::vector<Character> characters(count);
    std::memcpy(characters.data(), fed.data(), fed.size());
    const auto met = std::ranges::count(characters, false, &Character::stands_out);
    return stage.Draw(
        characters,
        fmt::format("{} characters follow their targets at {:g} Hz, within their joint limits", count, rate_hz),
        fmt::format("{:.2f} s: {} characters reach the targets of hands and feet; the others are pale",
                    frame * every / rate_hz, met));
  };
  return EncodeFedFrames(options.output, frames, rate_hz / every, {count * sizeof(Character), fill}, draw, watch);
}

/// Solves the poses of the crowd frame by frame, and makes the film if one was requested. Prints and returns the
/// measured times; returns null if Ctrl-C was pressed.
Result<Json> FollowCrowd(const CrowdCommandOptions& options) {
  ASSIGN_OR_RETURN(const auto worlds, MakeCrowd(options.crowd));
  FollowedCrowd followed(options, worlds);
  const Interrupt interrupt;
  if (!options.output.empty()) {
    ASSIGN_OR_RETURN(const bool is_whole,
                     UnlessInterrupted(FilmCrowd(options, followed, WatchFilms(interrupt, options.jobs)), interrupt));
    if (!is_whole) return Json();
  }
  for (int frame = 0; frame < options.crowd.frames; ++frame) {
    if (*interrupt.requested()) return Json();
    followed.FollowTo(frame);
  }
  return Tell(options, followed.timings());
}

Result<int> CrowdCommand(const CrowdCommandOptions& given) {
  CrowdCommandOptions options = given;
  options.crowd.frames = static_cast<int>(std::lround(options.seconds * options.crowd.rate_hz));
  if (options.crowd.frames < kMinTrackedFrames) {
    return Fail({}, "--seconds: {:g} s at {:g} Hz give {} frames; allowed: {} frames or more", options.seconds,
                options.crowd.rate_hz, options.crowd.frames, kMinTrackedFrames);
  }
  RETURN_IF_ERROR(CheckOutput(options.output, options.overwrite, ".mp4"));
  StdoutToStderr aside(options.as_json);
  ASSIGN_OR_RETURN(Json facts, FollowCrowd(options));
  if (facts.is_null()) return TellStopped();
  if (!options.output.empty()) TellWritten(options.output);
  aside.End();
  if (options.as_json) RETURN_IF_ERROR(PrintFacts("crowd", std::move(facts)));
  return kSuccess;
}

}  // namespace

void DefineCrowd(CLI::App& app, Action& action) {
  auto options = std::make_shared<CrowdCommandOptions>();
  CLI::App* command =
      app.add_subcommand("crowd", "Solve the poses of a crowd frame by frame, and make a film of the crowd");
  command->add_option("--characters", options->crowd.characters, "Number of characters; each has its own motion")
      ->check(CLI::Range(1, 10'000));
  command->add_option("--seconds", options->seconds, "Duration, seconds")->check(NumberWithin(0.01, 60, "time in s"));
  command->add_option("--rate", options->crowd.rate_hz, "Frames per second")
      ->check(NumberWithin(1, 1000, "rate in Hz"));
  command->add_option("--steps", options->steps, "Maximum number of Gauss–Newton steps per character and frame")
      ->check(CLI::Range(1, 10'000));
  AddSeed(*command, options->crowd.seed, "Seed of the motions");
  command->add_flag("--float", options->in_float, "Solve in single precision (float), not in double precision");
  command->add_option("-o,--output", options->output, "Write a film of the crowd (.mp4)");
  AddJobs(*command, options->jobs);
  AddOverwrite(*command, options->overwrite);
  AddJson(*command, options->as_json);
  command->callback([=, &action] { action = [=] { return Finish(CrowdCommand(*options)); }; });
}

}  // namespace etude
