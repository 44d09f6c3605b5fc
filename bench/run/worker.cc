#include "bench/run/worker.h"

#include <Eigen/Core>
#include <csignal>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "bench/process/child_process.h"
#include "bench/run/cell_line.h"
#include "bench/run/cell_runner.h"
#include "bench/run/outside_programs.h"
#include "bench/run/plan.h"
#include "bench/run/secret_key.h"

namespace etude {
namespace {

/// Eigen chooses its block sizes by the CPU's caches, and with them the order of its sums; a fixed
/// choice keeps the bytes the same on every machine.
void FixEigenBlocking() { Eigen::setCpuCacheSizes(32 * 1024, 256 * 1024, 2 * 1024 * 1024); }

int ProtocolError(const Error& error) {
  std::cerr << ToString(error) << '\n';
  return 2;
}

void Answer(std::size_t number, FinishedCell cell, std::ostream& out) {
  const std::string why = cell.why_not_run;
  out << (why.empty() ? EncodeCellLine(number, std::move(cell)) : kNotRun + why) << '\n' << std::flush;
}

/// Measures an answered cell.
Result<void> Measure(const std::string& line, const Plan& plan, std::span<const std::unique_ptr<CellRunner>> runners,
                     std::ostream& out) {
  const Place place{"a worker's orders"};
  const auto head = ReadCellLineHead(line);
  if (!head || head->cell >= plan.cell_count()) return Fail(place, "not the line of a cell");
  ASSIGN_OR_RETURN(auto answered, DecodeCellLine(line, plan.IdentityOf(head->cell), place));
  const World& world = plan.world(plan.WorldOf(head->cell));
  Answer(head->cell, runners[static_cast<std::size_t>(world.scenario)]->Measure(world.condition, std::move(answered)),
         out);
  return {};
}

/// Runs the methods of one order, answering as it goes.
Result<void> Execute(const Json& order, std::span<const std::unique_ptr<CellRunner>> runners, std::ostream& out) {
  const Json& world = order.at("world");
  const auto scenario = world.at(0).get<std::size_t>();
  if (scenario >= runners.size()) return Fail({}, "there is no scenario {}", scenario);
  const auto first_cell = order.at("first_cell").get<std::size_t>();
  CellRunner& runner = *runners[scenario];
  runner.Open(world.at(1).get<int>(), world.at(2).get<int>());
  out << kWorldBuilt << '\n' << std::flush;
  for (const Json& method : order.at("methods")) {
    const auto number = method.get<std::size_t>();
    Answer(first_cell + number, runner.Run(number), out);
  }
  return {};
}

}  // namespace

int RunWorker(std::istream& in, std::ostream& out) {
  FixEigenBlocking();
  AdoptOrphans();
  // A job scheduler signals every process of a job; only the parent decides whether workers stop.
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
  std::string line;
  if (!std::getline(in, line)) return 0;
  const Place place{"a worker's set-up", 1, 0};
  const auto json = ReadJson(line, place.file, place.line);
  if (!json) return ProtocolError(json.error());
  try {
    auto setup = DecodeSetup(json->at("setup"), place);
    if (!setup) return ProtocolError(setup.error());
    if (const auto key = ParseWords256(json->value("key", ""))) {
      if (auto opened = OpenSeeds(SecretKey{*key, ""}, place, *setup); !opened) return ProtocolError(opened.error());
    }
    const auto scenarios = PrepareAll(*setup);
    if (!scenarios) return ProtocolError(scenarios.error());
    const Fence fence = DecodeFence(json->at("fence"));
    std::vector<std::unique_ptr<CellRunner>> runners;
    for (const PreparedScenario& scenario : *scenarios) {
      runners.push_back(std::make_unique<CellRunner>(scenario, json->at("error_folder").get<std::string>(), fence));
    }
    std::optional<Plan> plan;  // a large run's is worth making only where cells are measured
    out << kWorkerReady << '\n' << std::flush;
    while (std::getline(in, line)) {
      if (line.starts_with(kAnsweredBegin)) {
        if (!plan) plan.emplace(*scenarios);
        if (auto done = Measure(line, *plan, runners, out); !done) return ProtocolError(done.error());
        continue;
      }
      const auto order = ReadJson(line, "a worker's orders");
      if (!order) return ProtocolError(order.error());
      if (auto done = Execute(*order, runners, out); !done) return ProtocolError(done.error());
    }
  } catch (const Json::exception& error) {
    return ProtocolError({place, error.what()});
  }
  return 0;
}

}  // namespace etude
