#pragma once

#include <string>
#include <vector>

#include "bench/model/recording.h"
#include "bench/model/run_data.h"

namespace etude {

/// A cell that kept a recording with motions.
struct RecordedCell {
  const Row* row = nullptr;
  const Recording* recording = nullptr;
};

/// The recorded cells of one world.
struct RecordedWorld {
  std::size_t scenario = 0;  ///< index into RunData::scenarios
  std::string file;          ///< of its motions, below `report`: "motions/capture-1.js"; harmless characters only
  std::vector<RecordedCell> cells;  ///< in the order of the scenario's methods; never empty

  /// Names the world: "joint_noise_deg=5, trial 3".
  std::string Name() const;
};

/// Lists the worlds of which a run kept motions, in the order of its rows. The run must outlive them.
std::vector<RecordedWorld> RecordedWorlds(const RunData& run);

/// Writes the element of the page that says which file holds the motions of which cells, as JSON for the viewer; "" for
/// a run without any.
std::string ViewerIndexHtml(const RunData& run);

/// Writes buttons that open the recorded worlds of a scenario; the script shows them, for without it they do nothing.
std::string WatchHtml(const RunData& run, std::size_t scenario);

}  // namespace etude
