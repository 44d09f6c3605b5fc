#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/replay/replay.h"

namespace etude {

/// One check of a result folder, and the differences that it found.
struct Verified {
  /// The check and its extent, e.g. "summary.json: equal to a summary computed again from 480 rows".
  std::string what;
  std::vector<std::string> differences;  ///< the differences found; empty if there are none
};

struct VerifyOutcome {
  std::vector<Verified> checks;
  std::optional<CellChoice> choice;  ///< the cells that were run again; nullopt if none were
};

/// Checks that a result folder is consistent, even if somebody renewed its seal. It checks the seal and the set of
/// files. The rows must be those of the manifest, in the form in which a run writes them. The summary and its
/// expectations are computed again from the rows. With `replays`, the clips and units of every row are checked too, and
/// the cells that `options` choose are run again; secret worlds need their key. The times and the description of the
/// machine cannot be checked. Fails if the folder cannot be read.
Result<VerifyOutcome> VerifyRun(const ReplayOptions& options, bool replays);

}  // namespace etude
