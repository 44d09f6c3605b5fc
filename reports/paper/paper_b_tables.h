#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "reports/paper/paper_table.h"

namespace etude {

/// Tables 5.1 and 5.2 of paper B, filled from a run: of one trial, or summed up over all.
struct PaperBSet {
  std::string title;                  ///< "trial 0", "all 200 trials"
  std::string error_note;             ///< what the figures of `errors` are, in words
  std::string angle_note;             ///< what those of `angles` are; "" without any
  std::string replay;                 ///< the command that repeats the trial; "" for all trials
  std::vector<PaperTable> errors;     ///< "(a) before", then one per method: of each effector
  std::vector<PaperTable> angles;     ///< one per method: the hidden angles of each joint
  std::vector<std::string> outcomes;  ///< one line per method: how it ended, after how many iterations
};

struct PaperBCondition {
  std::vector<SweptValue> condition;
  std::vector<PaperBSet> sets;  ///< the first trial; then, when there are several, all
};

/// Whether any cell of this scenario keeps what the tables are made of: its task is `ik`, and it asks to
/// `record: [effector_errors]`.
bool HasPaperBTables(const RunData& run, const ScenarioSummary& scenario);

/// One entry per condition whose cells keep effectors' errors; empty for other scenarios. A method without such figures
/// has no table, and its line in `outcomes` says why.
std::vector<PaperBCondition> PaperBTables(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
