#include "cli/sensor_arguments.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/common_arguments.h"
#include "cli/sensor_commands.h"
#include "cli/validators.h"

namespace etude {
namespace {

constexpr const char* kSensorExamples =
    "\nA recording is a Kinect v2's text (25 joints a line: x y z, or x y z and a quaternion) or joint CSV (etude "
    "clip\n"
    "convert writes such files). A reference is the same motion by a system that can be trusted: 17 rigid targets of\n"
    "an optical system a line, or joint CSV. docs/sensor.md tells the formats, and what each statistic is.\n\n"
    "Try:\n"
    "  etude sensor stats kinect.txt                                        what it says by itself\n"
    "  etude sensor stats kinect.txt --reference vicon.txt --simulate v2    real beside simulated\n"
    "  etude sensor fit kinect.txt --reference vicon.txt -o sensor.yaml     then `sensor: sensor.yaml` in a scenario";

void AddSensorReading(CLI::App& command, SensorReading& reading) {
  command.add_option("--rate", reading.rate_hz, "Of the recording (default: its own times, else 30 Hz)")
      ->check(NumberWithin(1, 1000, "rate in Hz"));
  command
      .add_option("--reference-rate", reading.reference_rate,
                  "Of the reference (default: its own times, else the usual rate that gives the same length)")
      ->check(NumberWithin(1, 10000, "rate in Hz"));
}

void DefineStats(CLI::App& sensor, Action& action) {
  auto options = std::make_shared<SensorStatsOptions>();
  CLI::App* command = sensor.add_subcommand("stats", "The statistics of a sensor's recordings");
  command->add_option("files", options->files, "Recordings")->required();
  command->add_option("--reference", options->reading.reference, "The same motion by a system that can be trusted");
  command->add_option("--simulate", options->simulate, "Beside it, what this sensor says: v1, v2 or a sensor file");
  command->add_option("--worlds", options->worlds, "How many simulated recordings")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  AddSensorReading(*command, options->reading);
  command->callback([=, &action] { action = [=] { return SensorStatsCommand(*options); }; });
}

void DefineFit(CLI::App& sensor, Action& action) {
  auto options = std::make_shared<SensorFitCommandOptions>();
  CLI::App* command = sensor.add_subcommand("fit", "A sensor file for scenarios, fitted to a recording");
  command->add_option("file", options->file, "A recording")->required();
  command->add_option("--reference", options->reading.reference, "The same motion by a system that can be trusted")
      ->required();
  command->add_option("-o,--output", options->output, "The sensor file to write (YAML)")->required();
  command->add_option("--base", options->base, "What is not fitted is as here: v1, v2 or a sensor file")
      ->capture_default_str();
  command->add_option("--worlds", options->worlds, "Simulated recordings per step")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--steps", options->steps, "Steps of simulate, compare, correct")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  AddOverwrite(*command, options->overwrite);
  AddSensorReading(*command, options->reading);
  command->callback([=, &action] { action = [=] { return SensorFitCommand(*options); }; });
}

void DefineSheet(CLI::App& sensor, Action& action) {
  auto options = std::make_shared<SensorSheetOptions>();
  CLI::App* command = sensor.add_subcommand(
      "sheet", "A contact sheet of the first world: both cameras, every effect at three strengths");
  command->add_option("scenario", options->scenario, "A scenario file")->required();
  command->add_option("-o,--output", options->output, "The picture to write (.png)")->required();
  AddSeed(*command, options->seed, "Seed of the world (default: the scenario's, else 1)");
  command->add_option("--clips", options->clips, "Clips instead of the scenario's own");
  AddOverwrite(*command, options->overwrite);
  command->callback([=, &action] { action = [=] { return SensorSheetCommand(*options); }; });
}

}  // namespace

void DefineSensor(CLI::App& app, Action& action) {
  CLI::App* sensor = app.add_subcommand("sensor", "What sensors see, how they err, and sensors fitted to recordings");
  sensor->require_subcommand(1);
  sensor->footer(kSensorExamples);
  DefineStats(*sensor, action);
  DefineFit(*sensor, action);
  DefineSheet(*sensor, action);
}

}  // namespace etude
