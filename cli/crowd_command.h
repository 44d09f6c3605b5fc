#pragma once

#include <string>

#include "bench/tasks/tracking/crowd.h"

namespace etude {

struct CrowdCommandOptions {
  CrowdOptions crowd;
  double seconds = 2;
  int steps = 100;  ///< a frame, at most: who is lost begins anew with so many
  bool in_float = false;
  std::string output;  ///< a film, "" = only told
  bool overwrite = false;
};

/// `etude crowd`: a crowd followed on one core, how long its frames take, and a film of it.
int CrowdCommand(const CrowdCommandOptions& options);

}  // namespace etude
