#include "cli/sensor_arguments.h"

#include <CLI/CLI.hpp>

#include "cli/sensor_sheet_command.h"

namespace etude {

void DefineSensor(CLI::App& app, Action& action) {
  CLI::App* sensor = app.add_subcommand("sensor", "What the sensors of a scenario see");
  sensor->require_subcommand(1);
  DefineSensorSheet(*sensor, action);
}

}  // namespace etude
