#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/replay/replay.h"

namespace etude {

/// One check of a result folder.
struct Verified {
  std::string what;                      ///< "summary.json: computed again from 480 rows"
  std::vector<std::string> differences;  ///< empty if all agrees
};

struct VerifyOutcome {
  std::vector<Verified> checks;
  std::optional<CellChoice> choice;  ///< the cells that were run again; nothing if none were
};

/// Checks that a result folder is consistent, even if its seal was renewed: the seal; the set of files; the rows, which
/// must be those of the manifest, written as a run writes them; and the summary with its expectations, computed again
/// from the rows. With `replays`, it also checks the clips and units of every row, and runs the cells again that
/// `options` choose; secret worlds need their key. The times and the description of the machine cannot be checked. Fails
/// if the folder cannot be read.
Result<VerifyOutcome> VerifyRun(const ReplayOptions& options, bool replays);

}  // namespace etude
