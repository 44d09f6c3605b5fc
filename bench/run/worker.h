#pragma once

#include <iosfwd>

namespace etude {

/// The line that a worker says once its set-up is done, before it is given a world.
constexpr const char* kWorkerReady = "ready";
/// The line that it says when an ordered world is built, before the cells of it.
constexpr const char* kWorldBuilt = "built";
/// The beginning of the line that stands in the place of a cell's when this machine kept it from being run; why
/// follows.
constexpr const char* kNotRun = "not run: ";

/// The exit code of a worker that this machine keeps from going on; what it was at is not run (EX_TEMPFAIL).
constexpr int kCannotGoOn = 75;

/// The whole life of a worker process (`etude worker`): one line of set-up,
/// `{"setup": …, "error_folder": "…", "fence": …}`, answered by kWorkerReady; then one line per order,
/// `{"world": [scenario, condition, trial], "first_cell": 12, "methods": [0, 2]}` with the number of the world's first
/// cell, answered by kWorldBuilt and one line per method, in order (cell_line.h, or kNotRun); or the line of a cell
/// that has yet to be measured, answered by that of the measured one. Ends when `in` does. Returns the exit code; 2
/// when it is told something that it cannot understand, kCannotGoOn when this machine keeps it from its work: memory
/// for the set-up, a pipe that takes its answers.
int RunWorker(std::istream& in, std::ostream& out);

}  // namespace etude
