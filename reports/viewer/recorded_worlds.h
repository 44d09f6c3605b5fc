#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/model/recording.h"
#include "bench/model/run_data.h"

namespace etude {

/// A cell with a recording that holds motions.
struct RecordedCell {
  const Row* row = nullptr;
  const Recording* recording = nullptr;
};

/// A world with its recorded cells: one for each method that was recorded.
struct RecordedWorld {
  std::size_t scenario = 0;  ///< index of the scenario in RunData::scenarios
  /// Path of the script file with the world's motions, relative to `report`: "motions/capture-1.js". The path needs no
  /// escaping in HTML or URLs.
  std::string file;
  std::vector<RecordedCell> cells;  ///< recorded cells in the order of the scenario's methods; never empty

  /// Returns the name of the world: "joint_noise_deg=5, trial 3"; for a pair of files, the name of the pair.
  std::string Name() const;
};

/// Returns true for tasks whose worlds are motion files; such worlds have the names of the files.
inline bool JudgesFiles(std::string_view task) { return task == "evaluation" || task == "plausibility"; }

/// Lists the worlds whose motions a run recorded, in the order of the run's rows. The run must outlive the result.
std::vector<RecordedWorld> RecordedWorlds(const RunData& run);

/// Returns a JSON element for the viewer: the script files with motions, and the cells in each file; "" for a run
/// without recorded motions.
std::string ViewerIndexHtml(const RunData& run);

/// Returns buttons that open the recorded worlds of a scenario in the viewer. The buttons are hidden until the page's
/// script shows them, because the buttons do not work without scripts.
std::string WatchHtml(const RunData& run, std::size_t scenario);

}  // namespace etude
