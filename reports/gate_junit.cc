#include <fmt/core.h>

#include <map>

#include "reports/gate_report.h"
#include "reports/gate_table.h"
#include "reports/gate_tail.h"
#include "reports/junit_xml.h"

namespace etude {
namespace {

Ruling RulingOf(const MetricMove& move) {
  if (IsRegression(move)) return Ruling::kUnmet;
  return move.movement == Movement::kUnclear ? Ruling::kUndecided : Ruling::kMet;
}

constexpr std::size_t kMostWorldsOfCase = 20;

JunitCase CaseOf(const MetricMove& move, const std::string& run_folder) {
  const GateTableRow row = TableRow(move);
  std::string detail = fmt::format("{}: {} -> {}, difference {}, p {}, in {} worlds", row.verdict, row.before,
                                   row.after, row.difference, row.p, row.worlds);
  for (const TailLine& line : TailLines(move, run_folder, kMostWorldsOfCase)) {
    detail += "\n" + line.world + (line.replay.empty() ? "" : ": " + line.replay);
  }
  return {fmt::format("{}, {}: {}", row.condition, row.method, row.metric), RulingOf(move), std::move(detail)};
}

}  // namespace

std::string WriteGateJunit(const GateReport& report) {
  std::string why;
  for (const std::string& reason : report.incomplete) why += reason + "\n";
  std::vector<JunitSuite> suites = {
      {"gate", {{"every cell can be judged", report.incomplete.empty() ? Ruling::kMet : Ruling::kUnmet, why}}}};
  std::map<std::string, std::size_t> places;
  const auto suite_of = [&](const std::string& scenario) -> JunitSuite& {
    const auto [place, is_new] = places.emplace(scenario, suites.size());
    if (is_new) suites.push_back({scenario, {}});
    return suites[place->second];
  };
  for (const GateExpectation& e : report.expectations) {
    suite_of(e.scenario).cases.push_back({e.result.text, e.result.ruling, e.result.detail});
  }
  for (const RatioResult& ratio : report.ratios) {
    suite_of(ratio.scenario).cases.push_back({RatioClaim(ratio), ratio.ruling, RatioDetail(ratio)});
  }
  for (const MetricMove& move : report.comparison.moves) {
    suite_of(move.identity.scenario).cases.push_back(CaseOf(move, report.run_folder));
  }
  return WriteJunitXml(report.suite + " gate", suites);
}

}  // namespace etude
