#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/model/summary.h"

namespace etude {

/// A case of a JUnit file: met passes, unmet is a failure, undecided is skipped.
struct JunitCase {
  std::string name;
  ClaimOutcome ruling;
  std::string detail;
  std::string said = {};  ///< what else a reader should know; told however the case ended
};

struct JunitSuite {
  std::string name;
  std::vector<JunitCase> cases;
};

/// Writes JUnit XML as CI systems read it, its counts made from the cases. `version` is Etude's, a property of each
/// suite.
std::string WriteJunitXml(const std::string& name, const std::vector<JunitSuite>& suites, const std::string& version);

/// Writes the run as JUnit XML: a suite per scenario; in it a case per expectation (failed when unmet, skipped when it
/// could not be decided), one that holds when every cell has its row, and one that holds when no cell crashed, failed,
/// ran out of time or answered badly.
std::string WriteJunit(const RunData& run);

}  // namespace etude
