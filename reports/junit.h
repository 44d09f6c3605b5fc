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
  std::string said = {};  ///< further text for readers, written whatever the verdict
};

struct JunitSuite {
  std::string name;
  std::vector<JunitCase> cases;
};

/// Returns JUnit XML in the form that CI systems read; the counts are computed from the cases. `version` is Etude's
/// version, a property of each suite.
std::string WriteJunitXml(const std::string& name, const std::vector<JunitSuite>& suites, const std::string& version);

/// Returns the run as JUnit XML, one suite per scenario. Each suite has one case per expectation (failed if unmet,
/// skipped if undecided), and one case that passes if every cell has a row. A last case passes if no cell crashed,
/// failed, timed out or gave an invalid answer; if the motions have no truth, one case per clip (ClipCases) replaces
/// it.
std::string WriteJunit(const RunData& run);

}  // namespace etude
