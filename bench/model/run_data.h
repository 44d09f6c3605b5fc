#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bench/model/row.h"
#include "bench/model/summary.h"

namespace etude {

struct CellSeries {
  std::string cell;  ///< Row::Id()
  std::vector<Series> series;
};

struct CellRecording {
  std::string cell;
  Recording recording;
};

/// A whole result folder in memory.
struct RunData {
  std::string suite;
  std::uint64_t seed = 1;
  std::string program_version;
  std::string command_line;  ///< from host.json
  std::string host;          ///< one line about the machine
  double wall_seconds = 0;
  std::vector<Row> rows;  ///< canonical order: scenario, condition, trial, method
  std::vector<ScenarioSummary> scenarios;
  std::vector<CellSeries> series;
  std::vector<CellRecording> recordings;
  std::string unsealed;  ///< why the folder is not as the run wrote it, when it was read all the same; else ""
  std::map<std::string, double> cpu_seconds;  ///< processor time, by Row::Id(); empty where the folder tells of none
};

}  // namespace etude
