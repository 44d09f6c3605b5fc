#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/run/plan.h"
#include "bench/scenario/scenario.h"
#include "io/files/file_path.h"

namespace etude {

/// Returns the folder name of each condition of a scenario, valid on every file system. Data sets and folders of
/// predictions contain worlds as SCENARIO/CONDITION/TRIAL.
///
/// The name is "all" if nothing is swept, else for instance "joint_noise_deg=5,noise=uniform". Characters other than
/// letters, digits and "._=,+-" become "_"; equal names then get "~2", "~3", … in order.
std::vector<std::string> ConditionFolders(const Scenario& scenario);

/// Returns the name of a world in the folder of its condition: the trial number ("007"). A secret world has 16
/// hexadecimal digits instead, from which the trial cannot be found without the key.
std::string WorldName(const PreparedScenario& scenario, int condition, int trial);

/// The faults found in a folder of predictions. Each entry names a file or a world.
struct PredictionFaults {
  std::vector<std::string> missing;    ///< worlds without an answer
  std::vector<std::string> extra;      ///< files that answer no world
  std::vector<std::string> duplicate;  ///< files for a world that already has an answer
  std::vector<std::string> broken;     ///< answers that cannot be read or have the wrong form, with the reason

  bool empty() const { return missing.empty() && extra.empty() && duplicate.empty() && broken.empty(); }
};

/// The file that answers each world of a plan, by the world's index; nullopt if no file answers it.
using PredictionFiles = std::vector<std::optional<FilePath>>;

/// Finds SCENARIO/CONDITION/TRIAL.json in `folder` for every world of the plan. TRIAL is a number, with or without
/// leading zeros, or the name of a secret world. In `faults`, links (which could lead to the truth) and pipes are
/// listed as broken, a second file for a world as duplicate, and files that answer no world as extra. Names that begin
/// with a dot are ignored. Fails if the folder cannot be read.
Result<PredictionFiles> FindPredictions(const std::filesystem::path& folder, const Plan& plan,
                                        PredictionFaults& faults);

}  // namespace etude
