#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/run/setup.h"

namespace etude {

/// One unit of work: a trial of a scenario under one of its conditions.
struct World {
  int scenario = 0;
  int condition = 0;
  int trial = 0;
};

/// What came back for one world.
struct WorldAnswer {
  std::size_t world = 0;  ///< its index in the list handed to the supervisor
  std::vector<Row> rows;  ///< one per method
  double wall_s = 0;
  double cpu_s = 0;
};

struct SupervisorOptions {
  std::string program;  ///< what to start as `PROGRAM worker`
  int jobs = 1;
  const std::atomic<bool>* stop = nullptr;  ///< set (by Ctrl-C) to end early
};

/// Hands worlds to worker processes and collects their rows. A worker that dies takes only its own world
/// with it: that world's rows become `crashed`, with the reason, and a new worker takes over. One that dies
/// in its set-up has no world to lose. `deliver` is called in order of completion. False when stopped early;
/// fails when no worker can start, or when several in a row die in their set-up.
Result<bool> RunWorlds(const SuiteSetup& setup, std::span<const PreparedScenario> scenarios,
                       std::span<const World> worlds, const SupervisorOptions& options,
                       const std::function<Result<void>(WorldAnswer)>& deliver);

}  // namespace etude
