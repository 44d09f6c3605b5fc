#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "bench/files/files.h"
#include "bench/films/encoder.h"
#include "bench/tasks/tracking/crowd.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "engine/kinematics/tree_to_body.h"
#include "reports/clips/crowd_stage.h"

namespace etude {
namespace {

struct CrowdCommandOptions {
  CrowdOptions crowd;
  double seconds = 2;
  int steps = 100;  ///< a frame, at most: who is lost begins anew with so many
  bool in_float = false;
  std::string output;  ///< a film, "" = only told
  bool overwrite = false, as_json = false;
};

constexpr int kWidth = 1280, kHeight = 720;
constexpr double kFilmRateHz = 30;  // at most: every second frame of 60 Hz

/// A film of every so many frames of the crowd.
class CrowdFilm {
 public:
  static Result<CrowdFilm> Start(const CrowdCommandOptions& options) {
    ASSIGN_OR_RETURN(auto renderer, Renderer::Create());
    const int every = std::max(1, static_cast<int>(std::ceil(options.crowd.rate_hz / kFilmRateHz)));
    const int rate = std::max(1, static_cast<int>(std::lround(options.crowd.rate_hz / every)));
    ASSIGN_OR_RETURN(auto encoder, Encoder::Start(options.output, kWidth, kHeight, rate));
    return CrowdFilm(options, every, std::move(renderer), std::move(encoder));
  }

  Result<void> Add(int frame, const KinematicTree& tree, const Crowd& crowd, int met) {
    if (frame % every_ != 0) return {};
    std::vector<CrowdStage::Character> characters;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
      characters.push_back({ToBodyPose(tree, crowd.StateOf(i)), !crowd.HasMet(i)});
    }
    return encoder_.Add(stage_.Draw(
        characters,
        fmt::format("{} characters followed at {:g} Hz, each within its joints' limits", crowd.size(), rate_hz_),
        fmt::format("{:.2f} s: {} meet the targets of all four ends; pale: who does not", frame / rate_hz_, met)));
  }
  Result<void> Finish() { return encoder_.Finish(); }

 private:
  CrowdFilm(const CrowdCommandOptions& options, int every, std::unique_ptr<Renderer> renderer, Encoder encoder)
      : every_(every),
        rate_hz_(options.crowd.rate_hz),
        renderer_(std::move(renderer)),
        stage_(options.crowd.characters, kWidth, kHeight, *renderer_),
        encoder_(std::move(encoder)) {}

  int every_;
  double rate_hz_;
  std::unique_ptr<Renderer> renderer_;
  CrowdStage stage_;
  Encoder encoder_;
};

double ProcessorTimeMs() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Timings {
  std::int64_t met = 0, steps = 0;
  std::vector<double> times_ms;  ///< of each frame
};

/// Prints what the crowd took, and gives the same for programs.
Json Tell(const CrowdCommandOptions& options, Timings timings) {
  const double count = static_cast<double>(options.crowd.characters) * options.crowd.frames;
  fmt::print("{} characters, {} frames at {:g} Hz, gauss-newton in batches of {}\n", options.crowd.characters,
             options.crowd.frames, options.crowd.rate_hz, options.in_float ? "floats" : "doubles");
  fmt::print("{:.2f} % of all poses meet their targets, after {:.2f} steps\n",
             100 * static_cast<double>(timings.met) / count, static_cast<double>(timings.steps) / count);
  const double first = timings.times_ms.front();
  std::sort(timings.times_ms.begin() + 1, timings.times_ms.end());
  const auto at = [&](double share) {
    return timings.times_ms[1 + static_cast<std::size_t>(share * static_cast<double>(timings.times_ms.size() - 2))];
  };
  fmt::print(
      "ms of one core a frame, of {:.1f} that there are: median {:.2f}, p99 {:.2f}, largest {:.2f}; the standing "
      "start {:.2f}\n",
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

/// Follows the crowd frame by frame, and tells of it. Null when Ctrl-C came.
Result<Json> FollowCrowd(const CrowdCommandOptions& options) {
  ASSIGN_OR_RETURN(const auto worlds, MakeCrowd(options.crowd));
  std::optional<CrowdFilm> film;
  if (!options.output.empty()) {
    ASSIGN_OR_RETURN(auto started, CrowdFilm::Start(options));
    film.emplace(std::move(started));
  }
  const Interrupt interrupt;
  Crowd crowd(worlds);
  Timings timings;
  IkOptions ik;
  ik.max_iterations = options.steps;
  for (int frame = 0; frame < options.crowd.frames; ++frame) {
    if (*interrupt.requested()) return Json();
    const double begin = ProcessorTimeMs();
    const auto [met, steps] = crowd.FollowNext(ik, options.in_float ? Precision::kFloat : Precision::kDouble);
    timings.times_ms.push_back(ProcessorTimeMs() - begin);
    timings.met += met;
    timings.steps += steps;
    if (film) RETURN_IF_ERROR(film->Add(frame, worlds[0].tree, crowd, met));
  }
  if (film) RETURN_IF_ERROR(film->Finish());
  return Tell(options, std::move(timings));
}

Result<int> CrowdCommand(const CrowdCommandOptions& given) {
  CrowdCommandOptions options = given;
  options.crowd.frames = static_cast<int>(std::lround(options.seconds * options.crowd.rate_hz));
  if (options.crowd.frames < kFewestTrackedFrames) {
    return Fail({}, "--seconds: {:g} s at {:g} Hz are {} frames; allowed: {} or more", options.seconds,
                options.crowd.rate_hz, options.crowd.frames, kFewestTrackedFrames);
  }
  if (!options.output.empty()) {
    if (std::filesystem::path(options.output).extension() != ".mp4") {
      return Fail({options.output}, "is no film's name; allowed: .mp4");
    }
    RETURN_IF_ERROR(CheckOutput(options.output, options.overwrite));
  }
  Aside aside(options.as_json);
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
  CLI::App* command = app.add_subcommand("crowd", "Follow a crowd's motions at once, and film it");
  command->add_option("--characters", options->crowd.characters, "How many, each after a motion of its own")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  command->add_option("--seconds", options->seconds, "How long")
      ->check(NumberWithin(0.01, 60, "time in s"))
      ->capture_default_str();
  command->add_option("--rate", options->crowd.rate_hz, "Frames per second")
      ->check(NumberWithin(1, 1000, "rate in Hz"))
      ->capture_default_str();
  command->add_option("--steps", options->steps, "Of gauss-newton, at most, for a character's frame")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  AddSeed(*command, options->crowd.seed, "Of the motions' dice");
  command->add_flag("--float", options->in_float, "Batches of floats, not of doubles");
  command->add_option("-o,--output", options->output, "A film of the crowd (.mp4)");
  AddOverwrite(*command, options->overwrite);
  AddJson(*command, options->as_json);
  command->callback([=, &action] { action = [=] { return Finish(CrowdCommand(*options)); }; });
}

}  // namespace etude
