#include "bench/run/worker.h"

#include <Eigen/Core>
#include <chrono>
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bench/results/row_json.h"
#include "bench/run/setup.h"

namespace etude {
namespace {

/// Eigen chooses its block sizes by the CPU's caches, and with them the order of its sums; a fixed
/// choice keeps the bytes the same on every machine.
void FixEigenBlocking() { Eigen::setCpuCacheSizes(32 * 1024, 256 * 1024, 2 * 1024 * 1024); }

double CpuSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Json Answer(const PreparedScenario& scenario, const Json& world) {
  const auto start = std::chrono::steady_clock::now();
  const double cpu_start = CpuSeconds();
  Json cells = Json::array();
  for (Row& row : scenario.RunWorld(world.at(1).get<int>(), world.at(2).get<int>())) {
    cells.push_back(EncodeCell(std::move(row)));
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  return {{"world", world}, {"cells", std::move(cells)}, {"wall_s", wall.count()}, {"cpu_s", CpuSeconds() - cpu_start}};
}

}  // namespace

int RunWorker(std::istream& in, std::ostream& out) {
  FixEigenBlocking();
  std::string line;
  if (!std::getline(in, line)) return 0;
  const auto json = ReadJson(line, "a worker's set-up", 1);
  const auto setup = json ? DecodeSetup(*json, {"a worker's set-up", 1, 0}) : tl::unexpected(json.error());
  if (!setup) {
    std::cerr << ToString(setup.error()) << '\n';
    return 2;
  }
  std::vector<PreparedScenario> scenarios;
  for (const ScenarioSetup& scenario : setup->scenarios) {
    auto prepared = Prepare(scenario);
    if (!prepared) {
      std::cerr << ToString(prepared.error()) << '\n';
      return 2;
    }
    scenarios.push_back(std::move(*prepared));
  }
  out << kWorkerReady << '\n' << std::flush;
  while (std::getline(in, line)) {
    const auto world = ReadJson(line, "a worker's orders");
    if (!world) return 2;
    const auto answer = WriteJson(Answer(scenarios.at(world->at(0).get<std::size_t>()), *world));
    if (!answer) return 2;
    out << *answer << '\n' << std::flush;
  }
  return 0;
}

}  // namespace etude
