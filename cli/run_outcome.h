#pragma once

#include <string>
#include <vector>

#include "bench/run/run.h"
#include "cli/facts.h"

namespace etude {

/// Prints the tables of a finished run, the doubts about judged files, and the reasons why methods have no answer. If
/// `aside` is given, ends it and prints the facts of the run as JSON (docs/schemas/facts.schema.json). Returns
/// kNothingWorked if a method has no answer or no cell is ok.
int ShowOutcome(const RunOutcome& outcome, StdoutToStderr* aside = nullptr);
/// Does the same for a shard, which has no tables; the merge of all shards makes the tables.
int ShowShard(const RunOutcome& outcome, const Shard& shard, StdoutToStderr* aside);

/// Returns a line "FILE: why" for each file that a run left out.
std::vector<std::string> LeftOutIn(const RunOutcome& outcome);

}  // namespace etude
