#pragma once

#include <iosfwd>

namespace etude {

/// A worker's line when its set-up is done, before its first world.
constexpr const char* kWorkerReady = "ready";
/// Its line when an ordered world is built, before the lines of the cells.
constexpr const char* kWorldBuilt = "built";
/// The beginning of its line for a cell that could not be run because of this machine; the reason follows.
constexpr const char* kNotRun = "not run: ";

/// The exit code of a worker that a fault of this machine stops (EX_TEMPFAIL); its current work is not run.
constexpr int kCannotGoOn = 75;

/// Runs a worker process (`etude worker`) until `in` ends. The first line is the set-up, `{"setup": …, "error_folder":
/// "…", "fence": …}`, answered by kWorkerReady. Each further line is an order or an answered cell. An order, `{"world":
/// [scenario, condition, trial], "first_cell": 12, "methods": [0, 2]}`, has the number of the world's first cell; the
/// answer is kWorldBuilt, then one line per method (cell_line.h, or kNotRun). For an answered cell, the metrics of
/// programs are measured, and the reply is the cell's new line. Returns the exit code: 2 if a line is invalid,
/// kCannotGoOn if this machine stops it.
int RunWorker(std::istream& in, std::ostream& out);

}  // namespace etude
