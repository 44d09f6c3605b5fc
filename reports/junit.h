#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/model/summary.h"

namespace etude {

/// A case of a JUnit file: kMet passes, kUnmet is a failure, kUndecided is skipped.
struct JunitCase {
  std::string name;
  ClaimOutcome ruling;
  std::string detail;
  std::string said = {};  ///< more that a reader should know, written whatever the ruling
};

struct JunitSuite {
  std::string name;
  std::vector<JunitCase> cases;
};

/// Returns JUnit XML as CI systems read it; the counts are computed from the cases. `version` is Etude's version, a
/// property of each suite.
std::string WriteJunitXml(const std::string& name, const std::vector<JunitSuite>& suites, const std::string& version);

/// Returns the run as JUnit XML, one suite per scenario. Its cases are: one per expectation (failed if unmet, skipped
/// if undecided), one that holds if every cell has a row, one that holds if no cell crashed, failed, timed out or
/// answered badly, and one per clip that has limits.
std::string WriteJunit(const RunData& run);

}  // namespace etude
