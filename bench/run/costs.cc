#include "bench/run/costs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bench/run/parallel_summary.h"
#include "bench/run/shipped.h"
#include "engine/base/digest.h"
#include "io/files/json.h"
#include "io/process/clock.h"

namespace etude {
namespace {

constexpr const char* kFormat = "etude-costs";
constexpr int kVersion = 1;

/// Keys of a scenario that do not affect the cost of the scenario's worlds and methods.
constexpr std::array kNoWork = {"scenario", "question", "description", "trials", "seed",  "unit", "methods", "metrics",
                                "expect",   "across",   "rival",       "gate",   "video", "name", "against"};

void Add(const Node& node, Digest& digest) {
  digest.Add(static_cast<std::int64_t>(node.kind)).Add(std::string_view(node.scalar));
  for (const Node& item : node.items) Add(item, digest);
  for (const Node::Entry& entry : node.entries) {
    if (std::ranges::find(kNoWork, entry.key) != kNoWork.end()) continue;
    digest.Add(std::string_view(entry.key));
    Add(entry.value, digest);
  }
}

/// Does one yardstick of work: a fixed amount of arithmetic on 4 KB of data, which fit into the first-level cache.
void DoOneYardstick(std::array<double, 512>& values) {
  constexpr std::size_t kPasses = 400, kStride = 7;
  for (std::size_t pass = 0; pass < kPasses; ++pass) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = std::sqrt(values[i] + values[(kStride * i + pass) % values.size()] + 0.25);
    }
  }
}

/// Repeats a fixed computation (a yardstick) until `seconds` have passed. Returns a JSON array: the number of
/// repetitions, their wall time and their processor time, seconds.
std::string DoYardsticks(double seconds) {
  std::array<double, 512> values{};
  const auto start = Clock::now();
  const std::clock_t began = std::clock();
  int done = 0;
  do {  // does at least one yardstick, even if other processes keep the processor busy
    DoOneYardstick(values);
    ++done;
  } while (SecondsSince(start) < seconds);
  const volatile double kept = values.front();  // reading the result keeps the compiler from removing the arithmetic
  static_cast<void>(kept);
  const double processor_s = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
  return Json{done, SecondsSince(start), processor_s}.dump();
}

}  // namespace

std::string WorkOf(const Scenario& scenario) {
  Digest digest;
  digest.Add(std::string_view(scenario.task));
  for (const Condition& condition : scenario.conditions) Add(condition.node, digest);
  for (const MethodEntry& method : scenario.methods) {
    digest.Add(static_cast<std::int64_t>(method.exec.size()));
    Add(method.node, digest);
  }
  return digest.Hex();
}

Result<std::map<std::string, KeptCost>> ReadKeptCosts() {
  std::map<std::string, KeptCost> costs;
  const std::filesystem::path file = ShippedFolder() / "scenarios" / "costs.json";
  if (std::error_code error; !std::filesystem::exists(file, error)) return costs;
  ASSIGN_OR_RETURN(const Json json, ReadJsonFile(file));
  try {
    if (json.at("format") != kFormat || json.at("version") != kVersion) {
      return Fail({file.string()}, "is not a table of costs of version {}", kVersion);
    }
    for (const Json& one : json.at("scenarios")) {
      costs[one.at("work").get<std::string>()] = {one.at("once").get<double>(), one.at("trial").get<double>(),
                                                  one.value("spread", 0.0),     one.value("units", 0),
                                                  one.value("trials", 0),       one.value("seed", std::uint64_t{0})};
    }
  } catch (const Json::exception& error) {
    return Fail({file.string()}, "not a table of costs: {}", error.what());
  }
  return costs;
}

Result<Pace> MeasurePace(int workers) {
  constexpr double kSeconds = 0.125;
  ASSIGN_OR_RETURN(const auto told,
                   RunForked(static_cast<std::size_t>(workers), workers,
                             [](std::size_t) -> Result<std::string> { return DoYardsticks(kSeconds); }));
  double all = 0, processor_s = 0, pace = 0;
  for (const std::string& one : told) {
    const Json json = Json::parse(one);
    const double done = json[0].get<double>();
    all += done;
    pace += done / json[1].get<double>();
    processor_s += json[2].get<double>();
  }
  return Pace{pace, 1000 * processor_s / all};
}

ExpectedWork::ExpectedWork(const Plan& plan, const std::map<std::string, KeptCost>& kept) : plan_(plan) {
  double cells_known = 0, work_known = 0;
  for (const PreparedScenario& one : plan.scenarios()) {
    const Scenario& scenario = one.scenario();
    const auto cost = kept.find(WorkOf(scenario));
    const double trials = one.setup().trials;
    const double cells = static_cast<double>(scenario.conditions.size() * scenario.methods.size()) * trials;
    const double work = cost == kept.end() ? 0 : cost->second.once + cost->second.trial * trials;
    per_cell_.push_back(work / cells);
    work_known += work;
    cells_known += work > 0 ? cells : 0;
  }
  is_known_ = work_known > 0;
  const double usual = is_known_ ? work_known / cells_known : 1;
  for (double& work : per_cell_) work = work > 0 ? work : usual;
}

}  // namespace etude
