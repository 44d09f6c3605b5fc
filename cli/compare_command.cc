#include <fmt/core.h>

#include "bench/finished_runs/load.h"
#include "bench/gate/comparison.h"
#include "cli/commands.h"
#include "cli/move_table.h"
#include "reports/gate_table.h"

namespace etude {
namespace {

/// A whole run's snapshot; one that is not whole cannot be paired world by world.
Result<Snapshot> LoadWholeRun(const std::string& folder) {
  ASSIGN_OR_RETURN(const auto run, LoadFinishedRun(folder));
  if (!run.incomplete.empty()) return Fail({folder, 0, 0}, "{}", run.incomplete.front());
  return TakeSnapshot(run);
}

}  // namespace

int CompareCommand(const std::string& a, const std::string& b) {
  auto before = LoadWholeRun(a);
  if (!before) return Complain(before.error());
  auto after = LoadWholeRun(b);
  if (!after) return Complain(after.error());
  const std::vector<std::string> incomparable = DropIncomparable(*before, *after);
  const SnapshotComparison comparison = CompareSnapshots(*before, *after, {});
  PrintMoves(comparison, "A", "B", comparison.moves.size());
  PrintList("Only in A:", comparison.only_before);
  PrintList("Only in B:", comparison.only_after);
  PrintList("Not comparable, for the worlds are not the same:", incomparable);
  PrintList("Methods with other settings:", comparison.settings_changed);
  fmt::print("{}\n", CompareSentence(comparison));
  return kSuccess;
}

}  // namespace etude
