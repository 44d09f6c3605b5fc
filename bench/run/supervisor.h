#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/run/cell_line.h"
#include "bench/run/journal.h"
#include "bench/run/plan.h"
#include "io/process/fence.h"

namespace etude {

struct SupervisorOptions {
  std::string program;       ///< what to start as `PROGRAM worker`
  std::string error_folder;  ///< where methods outside leave what they say on standard error; "" = nowhere
  Fence fence = {};          ///< that methods outside run in
  int jobs = 0;              ///< worker processes; 0 = one per processor
  const std::atomic<bool>* stop = nullptr;  ///< set (by Ctrl-C) to end early
  /// Cells that were answered and have yet to be measured: those of an earlier attempt, and those that Deliver puts
  /// there. Null = they are kept in a temporary file, and Deliver is given measured cells alone.
  CellTable* answered = nullptr;
  /// Is called when all methods have answered, before the first program that measures is started.
  std::function<Result<void>()> on_all_answered = {};
};

/// A cell that has ended, or was answered and has yet to be measured (CellLineHead::is_measured): the head of its line,
/// and the line (cell_line.h), which is as it was written.
struct DeliveredCell {
  CellLineHead head;
  std::string_view line;
  /// All that is known of it.
  Result<FinishedCell> Read(const Plan& plan) const;
};

/// Called for every cell, in order of completion; of those that other programs measure a second time.
using Deliver = std::function<Result<void>(const DeliveredCell& cell)>;

/// Hands worlds to worker processes and collects their cells, several worlds ahead where worlds are short, so that no
/// worker waits for this process. A worker that dies, takes longer or holds more
/// than the scenario's limits allow is ended and takes only the cell in progress with it: that cell's row becomes
/// `crashed`, `timeout` or `out_of_memory`, with the reason, and a new worker runs the world's other methods.
/// When it ends while it builds the world, all methods of the world get that row. One that dies in its set-up
/// holds no world and costs no cell. Programs that measure are told the truth, so they are started when all methods
/// have answered and all of these workers, with the programs of methods, have ended. False when stopped early; fails,
/// with an error of this machine (machine.h), when no worker can start, when several in a row die in their set-up, and
/// in the end when cells could not be run, which then were not delivered.
Result<bool> RunOrders(const SuiteSetup& setup, const Plan& plan, std::vector<Order> orders,
                       const SupervisorOptions& options, const Deliver& deliver);

/// True if programs measure cells of the plan.
bool HasOutsideMetrics(const Plan& plan);

/// The number of workers that `jobs` means: 0 is one per processor.
int WorkerCount(int jobs);

/// The program that is running, to be started again as a worker.
std::string ThisProgram();

}  // namespace etude
