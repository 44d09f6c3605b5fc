#include "reports/junit.h"

#include <fmt/core.h>

#include <set>

#include "io/drawing/escape.h"
#include "reports/faulty_clips.h"
#include "reports/words/findings.h"

namespace etude {
namespace {

std::string CaseXml(const std::string& suite, const JunitCase& c) {
  const std::string head =
      fmt::format("    <testcase classname=\"etude.{}\" name=\"{}\"", EscapeMarkup(suite), EscapeMarkup(c.name));
  const std::string detail = EscapeMarkup(c.detail);
  std::string body;
  if (c.outcome == ClaimOutcome::kUnmet) {
    // Most readers of JUnit list the message alone.
    const std::string message = detail.empty() ? "not met" : detail.substr(0, detail.find('\n'));
    body = fmt::format("<failure message=\"{}\">{}</failure>", message, detail);
  }
  if (c.outcome == ClaimOutcome::kUndecided) body = fmt::format("<skipped message=\"{}\"/>", detail);
  if (!c.said.empty()) body += fmt::format("<system-out>{}</system-out>", EscapeMarkup(c.said));
  return body.empty() ? head + "/>\n" : head + fmt::format(">{}</testcase>\n", body);
}

ClaimOutcome MetWhen(bool holds) { return holds ? ClaimOutcome::kMet : ClaimOutcome::kUnmet; }

// Returns a case that fails if a row is missing. The design is full factorial: if one method has a row in a world,
// every method must have one.
JunitCase EveryCellHasARow(const RunData& run, const ScenarioSummary& scenario) {
  std::set<std::string> ids;
  std::set<std::pair<std::string, int>> worlds;
  // If the run is too large for memory, `rows` is a sample, which contains whole worlds only.
  for (const Row& row : run.rows) {
    if (row.scenario != scenario.name) continue;
    ids.insert(row.Id());
    worlds.emplace(ConditionLabel(row.condition), row.trial);
  }
  const std::size_t wanted = worlds.size() * scenario.methods.size();
  return {"every cell has a row", MetWhen(ids.size() == wanted && wanted > 0),
          fmt::format("found {} of {} rows ({} worlds, {} methods)", ids.size(), wanted, worlds.size(),
                      scenario.methods.size())};
}

JunitCase NoCellBroke(const ScenarioFindings& findings) {
  int broken = 0;
  std::string detail;
  for (const ReasonCount& reason : findings.reasons) {
    // Unsolved and skipped cells do not fail this case; a scenario can forbid them in `expect`.
    if (reason.status == Status::kUnsolved || reason.status == Status::kSkipped) continue;
    broken += reason.cells;
    detail +=
        fmt::format("{} x {} in {}: {}\n", reason.cells, StatusName(reason.status), reason.method, reason.Words());
  }
  return {"no attempted cell broke", MetWhen(broken == 0), std::move(detail)};
}

/// Returns a case that always passes and shows the scenario's answer to readers of CI.
JunitCase TheAnswer(const ScenarioFindings& findings) {
  std::string said = findings.headline;
  for (const MethodFinding* finding : {&findings.answer, &findings.rival}) {
    if (!finding->is_compared || (finding == &findings.rival && !HasOtherRival(findings))) continue;
    said += fmt::format("{}{}: {}", said.empty() ? "" : "\n", finding->BothVerdicts(), finding->sentence);
  }
  return {"the question has an answer", MetWhen(true), "", std::move(said)};
}

std::vector<JunitCase> CasesOf(const RunData& run, const ScenarioSummary& scenario) {
  const ScenarioFindings findings = FindingsOf(run, scenario);
  std::vector<JunitCase> clips = ClipCases(run, scenario.name);
  std::vector<JunitCase> cases{EveryCellHasARow(run, scenario)};
  // If the scenario judges clips, each clip that cannot be judged already fails its own case.
  if (clips.empty()) cases.push_back(NoCellBroke(findings));
  if (findings.answer.is_compared) cases.push_back(TheAnswer(findings));
  for (const ExpectationResult& e : scenario.expectations) {
    cases.push_back({e.text, e.outcome, e.detail, fmt::format("judged on {}", TheseUnits(scenario.unit))});
  }
  for (JunitCase& clip : clips) cases.push_back(std::move(clip));
  return cases;
}

}  // namespace

std::string WriteJunitXml(const std::string& name, const std::vector<JunitSuite>& suites, const std::string& version) {
  std::string body;
  std::size_t all = 0, all_failed = 0, all_skipped = 0;
  for (const JunitSuite& suite : suites) {
    std::size_t failed = 0, skipped = 0;
    std::string cases;
    for (const JunitCase& c : suite.cases) {
      failed += c.outcome == ClaimOutcome::kUnmet;
      skipped += c.outcome == ClaimOutcome::kUndecided;
      cases += CaseXml(suite.name, c);
    }
    body += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\">\n"
        "    <properties><property name=\"etude\" value=\"{}\"/></properties>\n{}  </testsuite>\n",
        EscapeMarkup(suite.name), suite.cases.size(), failed, skipped, EscapeMarkup(version), cases);
    all += suite.cases.size();
    all_failed += failed;
    all_skipped += skipped;
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" "
      "skipped=\"{}\">\n{}</testsuites>\n",
      EscapeMarkup(name), all, all_failed, all_skipped, body);
}

std::string WriteJunit(const RunData& run) {
  std::vector<JunitSuite> suites;
  for (const ScenarioSummary& scenario : run.scenarios) suites.push_back({scenario.name, CasesOf(run, scenario)});
  return WriteJunitXml(run.suite, suites, run.program_version);
}

}  // namespace etude
