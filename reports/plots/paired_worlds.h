#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "reports/words/judged.h"

namespace etude {

/// A world in which both methods of a comparison have a value, as shown: shares are per cent already.
struct PairedWorld {
  int trial = 0;
  std::size_t unit = 0;  ///< index of PairedDots::units; of several units (clip left × clip entered) the first
  double baseline = 0, method = 0;

  double Difference() const { return method - baseline; }
};

/// The worlds behind one comparison, at most kMostWorlds of them.
struct PairedDots {
  std::vector<PairedWorld> worlds;  ///< in the order of trials
  std::vector<std::string> units;   ///< in the order of their names; empty where worlds are units
  std::size_t total = 0;            ///< of which `worlds` are every so manyeth
};
inline constexpr std::size_t kMostWorlds = 400;

/// Empty when no world has both, or the other is no single method (a rival that half of the worlds chose).
PairedDots PairedWorldsOf(const RunData& run, const ScenarioSummary& scenario, const Judged& judged);

}  // namespace etude
