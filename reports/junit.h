#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/model/summary.h"

namespace etude {

/// A case of a JUnit file: kMet passes, kUnmet is a failure, kUndecided is skipped.
struct JunitCase {
  std::string name;
  ClaimOutcome outcome;
  std::string detail;
  std::string said = {};  ///< further text for readers, written for every outcome
};

struct JunitSuite {
  std::string name;
  std::vector<JunitCase> cases;
};

/// Returns JUnit XML in the form that CI systems read. The numbers of tests, failures and skipped tests are computed
/// from the cases. `version` is Etude's version, which becomes a property of each suite.
std::string WriteJunitXml(const std::string& name, const std::vector<JunitSuite>& suites, const std::string& version);

/// Returns the run as JUnit XML, one suite per scenario. A suite has one case that passes if every cell has a row, one
/// that passes if no cell crashed, failed, timed out or gave an invalid answer, one that always passes and states the
/// scenario's answer (if methods are compared), and one per expectation (failed if unmet, skipped if undecided). If the
/// motions have no ground truth, the suite has one case per clip (ClipCases) instead of the case for cells that
/// crashed, failed, timed out or gave an invalid answer.
std::string WriteJunit(const RunData& run);

}  // namespace etude
