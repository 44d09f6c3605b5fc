#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/replay/replay.h"

namespace etude {

/// One thing that a result folder says, held against what it must say.
struct Verified {
  std::string what;                      ///< "summary.json: computed again from 480 rows"
  std::vector<std::string> differences;  ///< empty when it agrees
};

struct VerifyOutcome {
  std::vector<Verified> checks;
  std::optional<CellChoice> choice;  ///< the cells that were run again; nothing = none were
};

/// Holds a result folder against itself and against this program, whether or not its seal was made anew: the seal; the
/// files, that they are those which such a run leaves; the rows, that they are those which the manifest asks for, and
/// written as a run writes them; the summary, its expectations among it, computed again from them; and, with `replays`,
/// the clips and units of every row and the cells that `options` choose, run again, for which secret worlds need their
/// key. Fails when the folder cannot be read. The folder's times and what it says of its machine are beyond it.
Result<VerifyOutcome> VerifyRun(const ReplayOptions& options, bool replays);

}  // namespace etude
