#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/arguments.h"

namespace etude {

struct SensorSheetOptions {
  std::string scenario;
  std::string output = "sheet.png";
  std::optional<std::uint64_t> seed;
  std::vector<std::string> clips;  ///< replaces the scenario's when not empty
  bool overwrite = false;
};

/// `etude sensor sheet`: a contact sheet of the scenario's first world.
int SensorSheetCommand(const SensorSheetOptions& options);

/// Defines it as a subcommand of `etude sensor`.
void DefineSensorSheet(CLI::App& sensor, Action& action);

}  // namespace etude
