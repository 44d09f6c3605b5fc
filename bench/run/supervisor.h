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
  std::string program;                      ///< started as `PROGRAM worker`
  std::string error_folder;                 ///< folder for the standard error of outside methods; "" = they share ours
  Fence fence = {};                         ///< the sandbox of outside methods
  int jobs = 0;                             ///< worker processes; 0 = one per processor
  const std::atomic<bool>* stop = nullptr;  ///< set to true (by Ctrl-C) to end early
  /// The cells that are answered but not yet measured: those of an earlier attempt, and those that Deliver adds. Null =
  /// they are kept in a temporary file, and Deliver receives measured cells only.
  CellTable* answered = nullptr;
  /// Called again and again while workers work, many times a second.
  std::function<void()> on_wait = {};
  /// Called when all methods have answered, before the first measuring program starts.
  std::function<Result<void>()> on_all_answered = {};
};

/// A finished or answered cell (CellLineHead::is_measured): its line as the worker wrote it, and the head of that line.
struct DeliveredCell {
  CellLineHead head;
  std::string_view line;
  Result<FinishedCell> Read(const Plan& plan) const;
};

/// Called for every cell in order of completion, and again after outside metrics have measured the cell.
using Deliver = std::function<Result<void>(const DeliveredCell& cell)>;

/// Gives worlds to worker processes and collects their cells; short worlds are given several at a time, so that no
/// worker waits. A worker that dies, or exceeds the scenario's limits of time or memory, is ended. Only the cell in
/// progress is lost: its row becomes `crashed`, `timeout` or `out_of_memory`, with the reason, and a new worker runs
/// the world's other methods. If the worker ended while it built the world, all methods of the world get that row. A
/// worker that dies during its set-up costs no cell. Programs that measure learn the truth, so they are started only
/// after all methods have answered and these workers, with the methods' programs, have ended.
/// Returns false if stopped early. Fails with an error of this machine (machine.h) if no worker can start, if several
/// in a row die during their set-up, or, at the end, if cells could not be run and were not delivered.
Result<bool> RunOrders(const SuiteSetup& setup, const Plan& plan, std::vector<Order> orders,
                       const SupervisorOptions& options, const Deliver& deliver);

bool HasOutsideMetrics(const Plan& plan);

/// Returns the number of workers for `jobs`; 0 = one per processor.
int WorkerCount(int jobs);

std::string ThisProgram();

}  // namespace etude
