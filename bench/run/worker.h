#pragma once

#include <iosfwd>

namespace etude {

/// The line that a worker writes when its set-up is done, before its first world.
constexpr const char* kWorkerReady = "ready";
/// The line that a worker writes when a world is built, before the lines of the cells.
constexpr const char* kWorldBuilt = "built";
/// The beginning of the line that a worker writes for a cell that this machine could not run. The reason follows.
constexpr const char* kNotRun = "not run: ";

/// The exit code of a worker that ends because of a fault of this machine (EX_TEMPFAIL). The worker's current cell
/// counts as not run.
constexpr int kCannotGoOn = 75;

/// Runs a worker process (`etude worker`) until `in` ends. The first line is the set-up, `{"setup": …, "error_folder":
/// "…", "fence": …}`; the worker replies with kWorkerReady. Each further line is an order or an answered cell. An order
/// is `{"world": [scenario, condition, trial], "first_cell": 12, "methods": [0, 2]}`, where `first_cell` is the number
/// of the world's first cell. The worker replies with kWorldBuilt, then with one line per method (cell_line.h, or
/// kNotRun). For an answered cell, the worker asks the metric programs and replies with the cell's new line. Returns
/// the exit code: 2 if a line is invalid, kCannotGoOn if this machine has a fault.
int RunWorker(std::istream& in, std::ostream& out);

}  // namespace etude
