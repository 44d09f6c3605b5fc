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

struct MethodRows {
  std::string scenario, method;
  std::size_t rows = 0;
  std::string why_not;       ///< why the method's cells cannot be run again; "" = they can
  std::size_t drawable = 0;  ///< number of rows from which the sample is drawn
  /// The number of rows whose status depends on the machine that ran them (DependsOnMachine), by status.
  std::map<std::string, std::size_t> by_machine;
};

struct CellChoice {
  std::set<std::size_t> places;  ///< indices of the chosen cells' rows
  std::uint64_t dice = 0;        ///< the seed of the sample
  std::size_t drawn = 0, drawable = 0;
  std::size_t recorded = 0;  ///< number of cells chosen in addition to the sample, because they have a recording
  std::vector<MethodRows> methods;
};

/// Chooses the cells that the options name. If they name none, draws a sample in which every set of the requested size
/// is equally likely. Fails if a named cell does not exist or cannot be run again.
Result<CellChoice> ChooseCells(const ReplayOptions& options, const RunData& run, const PreparedRun& prepared);

/// Returns the probability that `drawn` cells, drawn at random from `cells` cells, include none of the `forged` cells
/// (hypergeometric distribution).
double ChanceOfMissing(std::size_t cells, std::size_t drawn, std::size_t forged);

/// A way to forge some of the cells from which the sample was drawn, and the probability that the sample contains none
/// of the forged cells.
struct MissedForgery {
  std::string method;  ///< "SCENARIO/METHOD" of the forged cells; "" = any cells
  std::size_t forged = 0, cells = 0;
  double chance = 0;
};

/// Returns three forgeries that a sample may miss: of one cell in twenty, of half of the cells of the method with the
/// fewest cells, and of a single cell. Empty if all cells are run again.
std::vector<MissedForgery> WhatIsMissed(const CellChoice& choice);

bool IsRecorded(const PreparedRun& run, const Row& row);

}  // namespace etude
