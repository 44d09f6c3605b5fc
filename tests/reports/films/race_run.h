#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"

namespace etude {

/// What a method of inverse kinematics does in a made-up world: its errors shrink by `rate` at every step.
struct Settling {
  std::string method;
  int trial = 0;
  double rate = 0.1;            ///< natural logarithm per iteration; errors begin at 20 cm and 40°
  std::vector<int> iterations;  ///< that were recorded; none = no recording
  Status status = Status::kOk;
  std::string reason = "";
};

/// A run of one ik scenario, "race", of these methods. Bodies settle as fast as their errors.
RunData RaceRun(const std::vector<Settling>& cells);

/// 0, 1, …, last
std::vector<int> EveryIteration(int last);

}  // namespace etude
