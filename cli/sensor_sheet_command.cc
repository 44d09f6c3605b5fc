#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/run/suite.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "io/files/files.h"
#include "tools/clips/contact_sheet.h"

namespace etude {
namespace {

struct SensorSheetOptions {
  std::string scenario, output;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> clips;  ///< if not empty, replaces the scenario's clips
  bool overwrite = false;
};

Result<void> WriteSheet(const SensorSheetOptions& options) {
  RunOptions run;
  run.scenarios = {options.scenario};
  run.seed = options.seed;
  run.clips = options.clips;
  ASSIGN_OR_RETURN(const auto suite, ReadSuite(run));
  ASSIGN_OR_RETURN(const auto scenarios, PrepareAll(suite));
  if (scenarios.empty()) return Fail({options.scenario, 0, 0}, "holds no scenario");
  const PreparedScenario& first = scenarios.front();
  const auto world = first.task(0).MakeWorld(first.KeyOf(0, 0), /*keeps_motion=*/false);
  if (const auto why = world->WhySkipped()) return Fail({options.scenario, 0, 0}, "{}", *why);
  const auto sheet = world->MakeSensorSheet();
  if (!sheet) return Fail({options.scenario, 0, 0}, "{}", sheet.error().message);
  ASSIGN_OR_RETURN(const auto png, DrawSensorSheet(*sheet));
  return WriteFileAtomically(options.output, png);
}

Result<int> SensorSheetCommand(const SensorSheetOptions& options) {
  if (!options.output.ends_with(".png")) return Fail({options.output}, "is not the name of a picture; allowed: .png");
  RETURN_IF_ERROR(CheckOutput(options.output, options.overwrite));
  RETURN_IF_ERROR(WriteSheet(options));
  TellWritten(options.output);
  return kSuccess;
}

}  // namespace

void DefineSheet(CLI::App& sensor, Action& action) {
  auto options = std::make_shared<SensorSheetOptions>();
  CLI::App* command = sensor.add_subcommand(
      "sheet", "Draw a contact sheet of the first world: both cameras, every effect at three strengths");
  command->add_option("scenario", options->scenario, "A scenario file")->required();
  command->add_option("-o,--output", options->output, "The picture to write (.png)")->required();
  AddSeed(*command, options->seed, "Seed of the world (default: the scenario's, else 1)");
  command->add_option("--clips", options->clips, "Clips instead of the scenario's own");
  AddOverwrite(*command, options->overwrite);
  command->callback([=, &action] { action = [=] { return Finish(SensorSheetCommand(*options)); }; });
}

}  // namespace etude
