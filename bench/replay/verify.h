#pragma once

#include <string>
#include <vector>

#include "bench/replay/replay.h"

namespace etude {

/// One thing that a result folder says, held against what it must say.
struct Verified {
  std::string what;                      ///< "summary.json: recomputed from 480 rows"
  std::vector<std::string> differences;  ///< empty when it agrees
};

/// Holds a result folder against itself and against this program, whether or not its seal was made anew: the seal; the
/// rows, that they are those which the manifest asks for; the summary, its expectations among it, computed again from
/// them; and, with `replays`, what recordings
/// there may be and the cells that `options` choose, run again, for which secret worlds need their key. Fails when the
/// folder cannot be read. The folder's times and what it says of its machine are beyond it.
Result<std::vector<Verified>> VerifyRun(const ReplayOptions& options, bool replays);

}  // namespace etude
