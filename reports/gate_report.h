#pragma once

#include <string>

#include "bench/gate/gate.h"

namespace etude {

/// Writes what a gate found as a comment on a pull request: the verdict, what fails, what else moved, what could not be
/// compared.
std::string WriteGateMarkdown(const GateReport& report);

/// Writes the same as JUnit XML: a suite per scenario, in it a case per expectation, time rule and comparison; an
/// incomplete run fails a case of the suite "gate".
std::string WriteGateJunit(const GateReport& report);

}  // namespace etude
