#pragma once

#include <functional>
#include <string>

#include "bench/gate/finished_run.h"

namespace etude {

/// Returns the result of an invented method in a world; it may also change the status, or leave values out.
using MakeResult = std::function<CellResult(int trial, const std::string& method)>;

/// Makes a run of a scenario "s" of task ik with the conditions noise=1 and noise=2, the methods "a" and "b", and 24
/// trials. `extra` holds further lines of its file. The worlds were made of one clip with the digest `clip_digest`.
FinishedRun ExampleRun(const MakeResult& make, const std::string& extra = "", const std::string& clip_digest = "clip");

/// The number of trials of an example, and the lines of its file from `metrics` on.
struct ExampleSetting {
  int trials = 24;
  std::string extra = "metrics: [position_error_cm, solved_practical]\n";
};
FinishedRun ExampleRun(const MakeResult& make, const ExampleSetting& setting, const std::string& clip_digest = "clip");

/// Returns a result with the value 10 + trial for both methods, plus `shift`.
CellResult ExampleResult(int trial, double shift = 0);

}  // namespace etude
