#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/scenario/scenario.h"

namespace etude {

/// Where things stand in an exported data set and in a folder of predictions: SCENARIO/CONDITION/TRIAL, as names that
/// every file system takes.
///
/// A condition is "all" when nothing is swept, else "joint_noise_deg=5,noise=uniform"; what is no letter, digit or one
/// of "._=,+-" becomes "_", and conditions that would then be one get "~2", "~3", … in order.
std::vector<std::string> ConditionFolders(const Scenario& scenario);

/// "007"
std::string TrialName(int trial);

}  // namespace etude
