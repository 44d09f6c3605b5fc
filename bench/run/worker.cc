#include "bench/run/worker.h"

#include <Eigen/Core>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "bench/run/cell_line.h"
#include "bench/run/cell_runner.h"
#include "bench/run/outside_programs.h"
#include "bench/run/plan.h"
#include "bench/run/secret_key.h"
#include "engine/base/machine.h"
#include "io/process/child_process.h"

namespace etude {
namespace {

/// Fixes the cache sizes from which Eigen chooses its block sizes. The order of Eigen's sums depends on the block
/// sizes, so fixed sizes give the same bytes on every machine.
void FixEigenBlocking() { Eigen::setCpuCacheSizes(32 * 1024, 256 * 1024, 2 * 1024 * 1024); }

int GiveUp(const Error& error) {
  std::cerr << ToString(error) << '\n';
  return IsOfThisMachine(error) ? kCannotGoOn : 2;
}

/// Writes a line to the supervisor and flushes it. If this fails, the worker ends, because the supervisor would wait
/// for the line forever.
Result<void> Say(const std::string& line, std::ostream& out) {
  if (out << line << '\n' << std::flush) return {};
  return FailOfMachine("a worker process cannot send its result: {}", std::strerror(errno));
}

Result<void> Answer(std::size_t number, FinishedCell cell, std::ostream& out) {
  const std::string why = cell.why_not_run;
  return Say(why.empty() ? EncodeCellLine(number, std::move(cell)) : kNotRun + why, out);
}

Result<void> Measure(const std::string& line, const Plan& plan, std::span<const std::unique_ptr<CellRunner>> runners,
                     std::ostream& out) {
  const Place place{"a worker's orders"};
  const auto head = ReadCellLineHead(line);
  if (!head || head->cell >= plan.cell_count()) return Fail(place, "not a line of a cell");
  ASSIGN_OR_RETURN(auto answered, DecodeCellLine(line, plan.IdentityOf(head->cell), place));
  const World& world = plan.world(plan.WorldOf(head->cell));
  CellRunner& runner = *runners[static_cast<std::size_t>(world.scenario)];
  return Answer(head->cell, runner.Measure(world.condition, std::move(answered)), out);
}

/// Runs the methods that an order (Order) lists for its world, and writes a line after each method.
Result<void> Execute(const Json& order, std::span<const std::unique_ptr<CellRunner>> runners, std::ostream& out) {
  const Json& world = order.at("world");
  const auto scenario = world.at(0).get<std::size_t>();
  if (scenario >= runners.size()) return Fail({}, "there is no scenario {}", scenario);
  const auto first_cell = order.at("first_cell").get<std::size_t>();
  CellRunner& runner = *runners[scenario];
  runner.Open(world.at(1).get<int>(), world.at(2).get<int>());
  RETURN_IF_ERROR(Say(kWorldBuilt, out));
  for (const Json& method : order.at("methods")) {
    const auto number = method.get<std::size_t>();
    RETURN_IF_ERROR(Answer(first_cell + number, runner.Run(number), out));
  }
  return {};
}

Result<void> Work(std::istream& in, std::ostream& out) {
  // Read the set-up, and make the scenarios, their seeds and a runner for each.
  std::string line;
  if (!std::getline(in, line)) return {};
  const Place place{"a worker's set-up", 1, 0};
  ASSIGN_OR_RETURN(const auto json, ReadJson(line, place.file, place.line));
  ASSIGN_OR_RETURN(auto setup, DecodeSetup(json.at("setup"), place));
  if (const auto key = ParseWords256(json.value("key", ""))) {
    RETURN_IF_ERROR(OpenSeeds(SecretKey{*key, ""}, place, setup));
  }
  ASSIGN_OR_RETURN(const auto scenarios, PrepareAll(setup));
  const Fence fence = DecodeFence(json.at("fence"));
  std::vector<std::unique_ptr<CellRunner>> runners;
  for (const PreparedScenario& scenario : scenarios) {
    runners.push_back(std::make_unique<CellRunner>(scenario, json.at("error_folder").get<std::string>(), fence));
  }
  std::optional<Plan> plan;  // made only if cells are to be measured, because a plan is large
  RETURN_IF_ERROR(Say(kWorkerReady, out));
  // Each line is an order, or a cell to be measured. Handle one line at a time.
  while (std::getline(in, line)) {
    if (line.starts_with(kAnsweredBegin)) {
      if (!plan) plan.emplace(scenarios);
      RETURN_IF_ERROR(Measure(line, *plan, runners, out));
      continue;
    }
    ASSIGN_OR_RETURN(const auto order, ReadJson(line, "a worker's orders"));
    RETURN_IF_ERROR(Execute(order, runners, out));
  }
  if (&in == &std::cin && std::ferror(stdin) != 0)
    return FailOfMachine("a worker process cannot read its instructions");
  return {};
}

}  // namespace

int RunWorker(std::istream& in, std::ostream& out) {
  FixEigenBlocking();
  AdoptOrphans();
  // A job scheduler signals every process of a job, but only the supervisor decides when workers stop. So ignore these
  // signals.
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
  // With the default handler, an invalid memory access by a method ends the worker, and its cell is recorded as
  // crashed.
  std::signal(SIGBUS, SIG_DFL);
  in.exceptions(std::ios::badbit);  // otherwise, a shortage of memory would look like the end of input
  try {
    const auto done = Work(in, out);
    return done ? 0 : GiveUp(done.error());
  } catch (const std::bad_alloc&) {
    return GiveUp(FailOfMachine("there is not enough memory for a worker process").value());
  } catch (const std::exception& error) {
    return GiveUp({{"a worker's orders"}, error.what()});
  }
}

}  // namespace etude
