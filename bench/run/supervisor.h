#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/run/cell_line.h"
#include "bench/run/journal.h"
#include "bench/run/plan.h"
#include "io/process/fence.h"

namespace etude {

struct SupervisorOptions {
  std::string program;  ///< path of this program; a worker is started as `PROGRAM worker`
  /// Folder for the standard error of outside methods; "" = they share Etude's standard error.
  std::string error_folder;
  Fence fence = {};                         ///< sandbox in which outside methods run
  int jobs = 0;                             ///< number of worker processes; 0 = one per processor
  const std::atomic<bool>* stop = nullptr;  ///< the run ends early when this becomes true (Ctrl-C)
  /// The cells that are answered but not yet measured: cells that a resumed run read from its journal, and cells that
  /// Deliver adds. If null, answered cells are stored in a temporary file, and Deliver receives measured cells only.
  CellTable* answered = nullptr;
  /// Called many times a second while the run waits for workers.
  std::function<void()> on_wait = {};
  /// Called after all methods have answered and before the first metric program starts.
  std::function<Result<void>()> on_all_answered = {};
};

/// A finished or answered cell (see CellLineHead::is_measured): the line that the worker wrote, and the line's head.
struct DeliveredCell {
  CellLineHead head;
  std::string_view line;
  Result<FinishedCell> Read(const Plan& plan) const;
};

/// Called for every cell in order of completion. A cell that outside programs measure is delivered twice: when it is
/// answered, and when it is measured.
using Deliver = std::function<Result<void>(const DeliveredCell& cell)>;

/// Gives worlds to worker processes and collects their cells. Several short worlds are given at a time, so that no
/// worker waits. A worker that exceeds the scenario's limits of time or memory is ended. If a worker dies or is
/// ended, only the cell in progress is lost: its row gets the status `crashed`, `timeout`, `out_of_memory` or
/// `bad_output`, with the reason, and a new worker runs the world's other methods. If the worker was still building
/// the world, all cells of the world get such a row. If the cause is a fault of this machine, lost cells get no row.
/// If a worker dies during its set-up, no cell is lost. Outside metric programs learn the truth. They are therefore
/// started only after all methods have answered and the methods' workers and programs have ended. Returns false if
/// the user stopped the run early. Fails with an error of this machine (machine.h) if no worker can start, if several
/// in a row die during their set-up, or, at the end, if cells could not be run and were not delivered.
Result<bool> RunOrders(const SuiteSetup& setup, const Plan& plan, std::vector<Order> orders,
                       const SupervisorOptions& options, const Deliver& deliver);

bool HasOutsideMetrics(const Plan& plan);

/// Returns the number of workers for the option `jobs`; 0 = one per processor.
int WorkerCount(int jobs);

}  // namespace etude
