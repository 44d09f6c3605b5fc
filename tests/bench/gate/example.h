#pragma once

#include <functional>
#include <string>

#include "bench/gate/finished_run.h"

namespace etude {

/// Returns an invented result of a method in a world. It may change the status or leave values out.
using MakeResult = std::function<CellResult(int trial, const std::string& method)>;

/// Makes a run of scenario "s" of task ik: conditions noise=1 and noise=2, methods "a" and "b", 24 trials, worlds of
/// one clip with the digest `clip_digest`. `extra` holds further lines of the scenario's file.
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
