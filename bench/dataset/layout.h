#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/run/plan.h"
#include "bench/scenario/scenario.h"
#include "io/files/file_path.h"

namespace etude {

/// Names the folders of a scenario's conditions in an exported data set and in a folder of predictions, where worlds
/// stand as SCENARIO/CONDITION/TRIAL, by names that every file system takes.
///
/// A condition is "all" when nothing is swept, else "joint_noise_deg=5,noise=uniform"; what is no letter, digit or one
/// of "._=,+-" becomes "_", and conditions that would then be one get "~2", "~3", … in order.
std::vector<std::string> ConditionFolders(const Scenario& scenario);

/// Names a world in its condition's folder: its trial, "007"; of a secret one sixteen digits, which only its key
/// connects with the trial.
std::string WorldName(const PreparedScenario& scenario, int condition, int trial);

/// The faults of a folder of predictions; each entry names a file or a world.
struct PredictionFaults {
  std::vector<std::string> missing;    ///< worlds without an answer
  std::vector<std::string> extra;      ///< files that answer no world
  std::vector<std::string> duplicate;  ///< files that answer a world that another file answers already
  std::vector<std::string> broken;     ///< answers that cannot be read, or are of the wrong size or shape, and why

  bool empty() const { return missing.empty() && extra.empty() && duplicate.empty() && broken.empty(); }
};

/// The file that answers each world of a plan; nothing where there is none.
using PredictionFiles = std::vector<std::optional<FilePath>>;

/// Finds SCENARIO/CONDITION/TRIAL.json in `folder`: a trial is its number, with or without leading zeros; of
/// secret worlds the name that export gave it. Everything else in there is noted as extra, but what begins with a dot;
/// a link, which may lead to the truth, or a pipe is noted as broken. Fails when the folder cannot be read.
Result<PredictionFiles> FindPredictions(const std::filesystem::path& folder, const Plan& plan,
                                        PredictionFaults& faults);

}  // namespace etude
