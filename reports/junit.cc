#include "reports/junit.h"

#include <fmt/core.h>

#include <set>

#include "reports/escape.h"
#include "reports/findings.h"

namespace etude {
namespace {

struct Case {
  std::string name;
  Outcome outcome;
  std::string detail;
};

Outcome MetWhen(bool holds) { return holds ? Outcome::kMet : Outcome::kUnmet; }

// A full factorial: every method must have a row in every world that any method has a row in.
Case EveryCellHasARow(const RunData& run, const ScenarioSummary& scenario) {
  std::set<std::string> ids;
  std::set<std::pair<std::string, int>> worlds;
  for (const Row& row : run.rows) {
    if (row.scenario != scenario.name) continue;
    ids.insert(row.Id());
    worlds.emplace(ConditionLabel(row.condition), row.trial);
  }
  const std::size_t wanted = worlds.size() * scenario.methods.size();
  return {
      "every cell has a row", MetWhen(ids.size() == wanted && wanted > 0),
      fmt::format("{} rows of {} ({} worlds, {} methods)", ids.size(), wanted, worlds.size(), scenario.methods.size())};
}

Case NoCellBroke(const ScenarioFindings& findings) {
  int broken = 0;
  std::string detail;
  for (const ReasonCount& reason : findings.reasons) {
    // Unsolved and skipped are honest answers; what a method may expect of itself is an expectation.
    if (reason.status == Status::kUnsolved || reason.status == Status::kSkipped) continue;
    broken += reason.cells;
    detail += fmt::format("{} x {} in {}: {}\n", reason.cells, StatusName(reason.status), reason.method, reason.reason);
  }
  return {"no cell broke", MetWhen(broken == 0), std::move(detail)};
}

std::vector<Case> CasesOf(const RunData& run, const ScenarioSummary& scenario) {
  std::vector<Case> cases{EveryCellHasARow(run, scenario), NoCellBroke(FindingsOf(run, scenario))};
  for (const ExpectationResult& e : scenario.expectations) cases.push_back({e.text, e.outcome, e.detail});
  return cases;
}

std::string CaseXml(const ScenarioSummary& scenario, const Case& c) {
  const std::string head = fmt::format("    <testcase classname=\"etude.{}\" name=\"{}\"", EscapeMarkup(scenario.name),
                                       EscapeMarkup(c.name));
  const std::string detail = EscapeMarkup(c.detail);
  switch (c.outcome) {
    case Outcome::kMet:
      return head + "/>\n";
    case Outcome::kUnmet:
      return head + fmt::format("><failure message=\"not met\">{}</failure></testcase>\n", detail);
    case Outcome::kUndecided:
      break;
  }
  return head + fmt::format("><skipped message=\"{}\"/></testcase>\n", detail);
}

}  // namespace

std::string WriteJunit(const RunData& run) {
  std::string suites;
  std::size_t all = 0, all_failed = 0, all_skipped = 0;
  for (const ScenarioSummary& scenario : run.scenarios) {
    const std::vector<Case> cases = CasesOf(run, scenario);
    std::size_t failed = 0, skipped = 0;
    std::string body;
    for (const Case& c : cases) {
      failed += c.outcome == Outcome::kUnmet;
      skipped += c.outcome == Outcome::kUndecided;
      body += CaseXml(scenario, c);
    }
    suites += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\">\n{}  </testsuite>\n",
        EscapeMarkup(scenario.name), cases.size(), failed, skipped, body);
    all += cases.size();
    all_failed += failed;
    all_skipped += skipped;
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" "
      "skipped=\"{}\">\n{}</testsuites>\n",
      EscapeMarkup(run.suite), all, all_failed, all_skipped, suites);
}

}  // namespace etude
