#pragma once

#include <functional>
#include <string>

#include "bench/gate/finished_run.h"

namespace etude {

/// What a made-up method reaches in a world; may also change the status, or leave values out.
using MakeResult = std::function<CellResult(int trial, const std::string& method)>;

/// A scenario "s" of task ik with the conditions noise=1 and noise=2, the methods "a" and "b", and 24 trials.
/// `extra` are more lines of its file; the worlds were made of one clip of that digest.
FinishedRun ExampleRun(const MakeResult& make, const std::string& extra = "", const std::string& clip_digest = "clip");

/// The same with so many trials, and lines of the file that begin with its `metrics`.
struct ExampleSetting {
  int trials = 24;
  std::string extra = "metrics: [position_error_cm, solved_practical]\n";
};
FinishedRun ExampleRun(const MakeResult& make, const ExampleSetting& setting, const std::string& clip_digest = "clip");

/// 10 + trial for either method, plus `shift`.
CellResult ExampleResult(int trial, double shift = 0);

}  // namespace etude
