#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/run/plan.h"
#include "bench/scenario/scenario.h"
#include "io/files/file_path.h"

namespace etude {

/// Returns the names of the folders of a scenario's conditions, valid on every file system. Exported data sets and
/// folders of predictions have worlds as SCENARIO/CONDITION/TRIAL.
///
/// A condition is "all" if nothing is swept, else "joint_noise_deg=5,noise=uniform". Characters other than letters,
/// digits and "._=,+-" become "_"; conditions whose names would then be equal get "~2", "~3", … in order.
std::vector<std::string> ConditionFolders(const Scenario& scenario);

/// Returns a world's name in its condition's folder: its trial, "007"; for a secret world sixteen digits, which only
/// its key maps to the trial.
std::string WorldName(const PreparedScenario& scenario, int condition, int trial);

/// The faults of a folder of predictions; each entry names a file or a world.
struct PredictionFaults {
  std::vector<std::string> missing;    ///< worlds without an answer
  std::vector<std::string> extra;      ///< files that answer no world
  std::vector<std::string> duplicate;  ///< files that answer a world that another file answers already
  std::vector<std::string> broken;     ///< answers that cannot be read, or have a wrong size or shape, and why

  bool empty() const { return missing.empty() && extra.empty() && duplicate.empty() && broken.empty(); }
};

/// The file that answers each world of a plan; nothing if there is none.
using PredictionFiles = std::vector<std::optional<FilePath>>;

/// Finds SCENARIO/CONDITION/TRIAL.json in `folder`. A trial is its number, with or without leading zeros; for secret
/// worlds, the exported name. All other files, except those that begin with a dot, are recorded as extra; links (which
/// could lead to the truth) and pipes as broken. Fails if the folder cannot be read.
Result<PredictionFiles> FindPredictions(const std::filesystem::path& folder, const Plan& plan,
                                        PredictionFaults& faults);

}  // namespace etude
