#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/scenario/scenario.h"

namespace etude {

/// Names the folders of a scenario's conditions in an exported data set and in a folder of predictions, where worlds
/// stand as SCENARIO/CONDITION/TRIAL, by names that every file system takes.
///
/// A condition is "all" when nothing is swept, else "joint_noise_deg=5,noise=uniform"; what is no letter, digit or one
/// of "._=,+-" becomes "_", and conditions that would then be one get "~2", "~3", … in order.
std::vector<std::string> ConditionFolders(const Scenario& scenario);

/// Names a trial: "007".
std::string TrialName(int trial);

}  // namespace etude
