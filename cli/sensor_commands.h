#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace etude {

/// What is told about recordings that cannot tell it themselves.
struct SensorReading {
  std::string reference;                 ///< the same motion by an optical system, "" = none
  std::optional<double> rate_hz;         ///< of the recordings
  std::optional<double> reference_rate;  ///< Hz
};

struct SensorStatsOptions {
  std::vector<std::string> files;
  SensorReading reading;
  std::string simulate;  ///< v1, v2 or a sensor file; "" = no simulated column
  int worlds = 64;
};
/// `etude sensor stats`: the statistics of recordings; with a reference and a sensor, real beside simulated.
int SensorStatsCommand(const SensorStatsOptions& options);

struct SensorFitCommandOptions {
  std::string file, output;
  SensorReading reading;
  std::string base = "v2";  ///< a preset or file for what is not fitted
  int worlds = 96;
  int steps = 10;
  bool overwrite = false;
};
/// `etude sensor fit`: a sensor file whose simulated recordings have a real one's statistics.
int SensorFitCommand(const SensorFitCommandOptions& options);

struct SensorSheetOptions {
  std::string scenario, output;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> clips;  ///< replaces the scenario's when not empty
  bool overwrite = false;
};
/// `etude sensor sheet`: a contact sheet of the scenario's first world.
int SensorSheetCommand(const SensorSheetOptions& options);

}  // namespace etude
