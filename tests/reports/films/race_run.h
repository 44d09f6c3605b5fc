#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"

namespace etude {

/// An invented method of inverse kinematics, whose errors shrink at the rate `rate` in every iteration.
struct Settling {
  std::string method;
  int trial = 0;
  double rate = 0.1;            ///< errors are multiplied by exp(−rate) per iteration, from 20 cm and 40° on
  std::vector<int> iterations;  ///< recorded iterations; none = no recording
  Status status = Status::kOk;
  std::string reason = "";
};

/// Makes a run of one ik scenario, "race", with these methods. Bodies converge as fast as their errors.
RunData RaceRun(const std::vector<Settling>& cells);

/// Returns 0, 1, …, last.
std::vector<int> EveryIteration(int last);

}  // namespace etude
