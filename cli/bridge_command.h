#pragma once

#include <string>
#include <vector>

#include "cli/clip_commands.h"

namespace etude {

struct BridgeCommandOptions {
  std::vector<std::string> clips;
  std::vector<std::string> to;  ///< corrective clips; none = the coach's own among `clips`
  std::string output;           ///< a tags file, "" = only the summary
  std::string check;            ///< a tags file to be checked instead
  std::string fuzzy;            ///< builtin:NAME or a file, "" = paper A's (of a check: as the file names it)
  double threshold = 0.4, wait_s = 1;
  int min_clips = 2, most_per_class = 0;
  bool within_class = false, as_json = false, overwrite = false;
  ClipReading reading;
};
/// `etude bridge`: bridge frames of clips, as a tags file and a summary; or, with `check`, whether a tags file is one
/// and fits its clips. Exit 2 when it does not.
int BridgeCommand(const BridgeCommandOptions& options);

}  // namespace etude
