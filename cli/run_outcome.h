#pragma once

#include <string>
#include <vector>

#include "bench/run/run.h"

namespace etude {

/// Prints the tables of a finished run, the doubts about judged files, and the reasons why methods have no answer.
/// Returns kNothingWorked if a method has no answer or no cell is ok.
int ShowOutcome(const RunOutcome& outcome);
/// Prints the facts of a run as JSON (docs/schemas/facts.schema.json). Returns `code`, or the code of a failure to
/// print.
int PrintOutcome(const RunOutcome& outcome, const Shard& shard, int code);
/// Returns a line "FILE: why" for each file that a run left out.
std::vector<std::string> LeftOutIn(const RunOutcome& outcome);

}  // namespace etude
