#pragma once

#include <string>
#include <vector>

#include "bench/gate/gate.h"

namespace etude {

/// A world that is far worse, in words.
struct TailLine {
  std::string world;   ///< "ik-weights, joint_noise_deg=5, trial 7, fixed: orientation error 0.05° → 60.1°"
  std::string replay;  ///< "etude replay out/now --cell …", fit for a shell; "" for a line that only counts the rest
};

/// One line for each of the first `most` far worse worlds of a move, the worst first, and one for how many more there
/// are. `run_folder` is where its cells can be replayed; "" = `RUN` stands there.
std::vector<TailLine> TailLines(const MetricMove& move, const std::string& run_folder, std::size_t most);

/// The lines of the moves that fail, or of those that do not, `most_each` worlds of one and `most` lines in all.
std::vector<TailLine> TailLines(const GateReport& report, bool failing, std::size_t most_each, std::size_t most);

}  // namespace etude
