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

/// The recorded cells of one world.
struct RecordedWorld {
  std::size_t scenario = 0;  ///< index in RunData::scenarios
  /// Path of the file with its motions, relative to `report`: "motions/capture-1.js"; only harmless characters.
  std::string file;
  std::vector<RecordedCell> cells;  ///< in the order of the scenario's methods; never empty

  /// Returns the name of the world: "joint_noise_deg=5, trial 3"; for a pair of files, the name of the pair.
  std::string Name() const;
};

/// Returns true for tasks whose worlds are motion files; the files' names are then the worlds' names.
inline bool JudgesFiles(std::string_view task) { return task == "evaluation" || task == "plausibility"; }

/// Lists the worlds of which a run recorded motions, in the order of its rows. The run must outlive the result.
std::vector<RecordedWorld> RecordedWorlds(const RunData& run);

/// Writes the page's JSON element that maps files to the cells whose motions they hold, for the viewer; "" for a run
/// without recorded motions.
std::string ViewerIndexHtml(const RunData& run);

/// Writes buttons that open the recorded worlds of a scenario. The page's script shows them; without scripts they stay
/// hidden, because they do not work.
std::string WatchHtml(const RunData& run, std::size_t scenario);

}  // namespace etude
