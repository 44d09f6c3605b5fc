#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/run/cell_runner.h"
#include "bench/run/plan.h"

namespace etude {

struct SupervisorOptions {
  std::string program;       ///< what to start as `PROGRAM worker`
  std::string error_folder;  ///< where methods outside leave what they say on standard error; "" = nowhere
  int jobs = 0;              ///< worker processes; 0 = one per processor
  const std::atomic<bool>* stop = nullptr;  ///< set (by Ctrl-C) to end early
};

/// Called with the number of a cell and what came of it, in order of completion.
using Deliver = std::function<Result<void>(std::size_t cell, FinishedCell finished)>;

/// Hands worlds to worker processes and collects their cells. A worker that dies, takes longer or holds more
/// than the scenario's limits allow is ended and takes only the cell in progress with it: that cell's row becomes
/// `crashed`, `timeout` or `out_of_memory`, with the reason, and a new worker runs the world's other methods.
/// When it ends while it builds the world, all methods of the world get that row. One that dies in its set-up
/// holds no world and costs no cell. False when stopped early; fails when no worker can start, or when several in a row
/// die in their set-up.
Result<bool> RunOrders(const SuiteSetup& setup, const Plan& plan, std::vector<Order> orders,
                       const SupervisorOptions& options, const Deliver& deliver);

/// How many workers `jobs` means: 0 is one per processor.
int WorkerCount(int jobs);

/// The program that is running, to be started again as a worker.
std::string ThisProgram();

}  // namespace etude
