#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/dataset/layout.h"
#include "bench/run/run.h"

namespace etude {

struct ScoreOptions {
  /// The path of a data set (or of any folder with a run's manifest), of a scenario file, or of a folder of *.yaml
  /// files.
  std::string target;
  std::string predictions;           ///< the folder of answers
  std::string output;                ///< the result folder
  std::string name = "predictions";  ///< the name of the method that gave the answers
  bool alone = false;                ///< true: the scenarios' own methods are not run
  bool allow_missing = false;        ///< true: a world without an answer is a failed cell, not an error
  /// Number of worker processes for the scenarios' own methods; 0 = one per processor.
  int jobs = 0;
  std::optional<std::uint64_t> seed;  ///< the seed for scenario files; a manifest states its own seed
  std::optional<SecretKey> key = {};
  std::optional<int> trials;
  std::vector<std::string> clips;
  std::string joint_map;
  std::string clip_facts = {};  ///< additional lines of the joint map (RunOptions::clip_facts)
  OutsideRules outside;
  std::string command_line;
  std::string program_version;
  const std::atomic<bool>* stop = nullptr;
};

struct ScoreOutcome {
  RunOutcome run;
  PredictionFaults faults;  ///< faults of the answers; if there are any, nothing was written
};

/// Scores answers from files and writes an ordinary result folder. The answers are those of one more method, which is
/// the last method of each scenario and is compared with the scenario's first method. Worker processes run the
/// scenarios' own methods. With `alone`, these methods are not run, nothing is compared, and no expectation is
/// judged. The calling process must have the pinned environment (io/process/closed_environment.h), because it judges
/// the answers itself.
Result<ScoreOutcome> ScorePredictions(const ScoreOptions& options,
                                      const std::function<void(const Progress&)>& on_progress);

}  // namespace etude
