#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "engine/base/result.h"

namespace etude {

struct PreparedRun;
struct ReplayOptions;

/// The rows of one method in one scenario.
struct MethodRows {
  std::string scenario, method;
  std::size_t rows = 0;
  std::string why_not;       ///< the reason why none of their cells can be run again; "" = they can
  std::size_t drawable = 0;  ///< rows that a sample is drawn from
  /// The rows that ended by the limits of the machine they were run on, by their status.
  std::map<std::string, std::size_t> by_machine;
};

/// The cells of a run that are run again.
struct CellChoice {
  std::set<std::size_t> places;  ///< of their rows
  std::uint64_t dice = 0;        ///< the seed that the sample was drawn by
  std::size_t drawn = 0, drawable = 0;
  std::size_t recorded = 0;  ///< chosen besides, because they left a recording
  std::vector<MethodRows> methods;
};

/// Chooses the cells that the options name, or draws a sample: every set of as many cells is equally likely. Fails when
/// the run holds no such cell, or one that cannot be run.
Result<CellChoice> ChooseCells(const ReplayOptions& options, const RunData& run, const PreparedRun& prepared);

/// The chance that `drawn` of `cells` hold none of the `forged` ones: the hypergeometric probability of zero.
double ChanceOfMissing(std::size_t cells, std::size_t drawn, std::size_t forged);

/// A way to forge cells of those that a sample was drawn from, and the chance that the sample misses all of them.
struct MissedForgery {
  std::string method;  ///< "SCENARIO/METHOD" whose cells are forged, "" = any cells
  std::size_t forged = 0, cells = 0;
  double chance = 0;
};

/// Tells what a sample misses: one cell in twenty, half of the cells of that method which has the fewest, a single
/// cell. Nothing where every cell is run again.
std::vector<MissedForgery> WhatIsMissed(const CellChoice& choice);

/// True if the run keeps a recording of the cell of this row.
bool IsRecorded(const PreparedRun& run, const Row& row);

}  // namespace etude
