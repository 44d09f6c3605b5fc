#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/results/run_data.h"
#include "engine/base/result.h"

namespace etude {

struct RunOptions {
  std::vector<std::string> scenarios;  ///< files, or folders of *.yaml
  std::optional<std::uint64_t> seed;   ///< else each scenario's own, else 1
  std::optional<int> trials;           ///< else each scenario's own
  std::vector<std::string> clips;      ///< replaces the scenarios' clips when not empty
  std::string output;                  ///< "" = out/<suite>-<seed>
  bool overwrite = false;              ///< replace a folder that already holds a run
  int jobs = 0;                        ///< worker processes; 0 = one per processor
  std::string command_line;            ///< for host.json
  std::string program_version;
  const std::atomic<bool>* stop = nullptr;
};

/// How far a run has come: called before the first world and after each.
struct Progress {
  std::size_t worlds_done = 0;
  std::size_t worlds = 0;
  std::size_t cells_ok = 0;
  std::size_t cells_done = 0;
  double seconds = 0;
};

struct RunOutcome {
  std::filesystem::path folder;
  std::size_t cells = 0;
  std::size_t cells_ok = 0;
  double seconds = 0;
  bool stopped = false;  ///< ended early; the journal holds what was done
};

/// Runs scenarios into a result folder. Everything that can be wrong with the input is found before
/// anything is written; from then on, every world that ends is flushed to journal.jsonl at once. A run that
/// ends before any world did leaves no folder that was not there before.
Result<RunOutcome> Run(const RunOptions& options, const std::function<void(const Progress&)>& on_progress);

}  // namespace etude
