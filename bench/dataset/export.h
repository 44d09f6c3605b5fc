#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/run/secret_key.h"
#include "engine/base/progress.h"
#include "engine/base/result.h"

namespace etude {

struct ExportOptions {
  std::vector<std::string> scenarios;  ///< paths of scenario files, or of folders with such files (*.yaml)
  std::optional<std::uint64_t> seed;   ///< seed of the worlds; nullopt = each scenario's own seed, else 1
  std::optional<SecretKey> key = {};   ///< the key of secret worlds, instead of a seed
  bool reuse_key = false;              ///< true: the key may have been used before (used_keys.h)
  std::optional<int> trials;           ///< trials per condition; nullopt = each scenario's own number
  std::vector<std::string> clips;      ///< if not empty, replaces the scenarios' clips
  std::string joint_map;               ///< if not empty, replaces the scenarios' joint maps
  std::string clip_facts = {};         ///< additional lines of the joint map (RunOptions::clip_facts)
  /// True: the true pictures of each world (depth, labels) are also written (TaskWorld::MakeTruePictures).
  bool depth = false;
  std::string output;
  std::string program_version;
};

struct ExportOutcome {
  std::size_t problems = 0;
  std::size_t skipped = 0;  ///< number of worlds in which no method can run; the index of the data set gives the reason
};

/// Writes the problems of all worlds and, separately, their truths (docs/datasets.md):
///
///     manifest.json                                a run's manifest, from which the same worlds can be made
///     README.md
///     inputs/index.csv                             one line per world
///     inputs/SCENARIO/CONDITION/setting.json       shared by the problems of a condition
///     inputs/SCENARIO/CONDITION/TRIAL/problem.json and its files; pictures of a take as one lossless film
///     truth/SCENARIO/CONDITION/TRIAL/truth.json and its files
///
/// The names and the order of secret worlds do not reveal their trials, and the index leaves out trial and clip. The
/// data set is written completely and synced to disk, or not at all. Fails before writing if the folder is not empty or
/// another export is writing it. The process must have the pinned environment (io/process/closed_environment.h), so
/// that pictures are the same on every machine. `on_progress` counts three steps per world: problem made, problem
/// written, truth written.
Result<ExportOutcome> ExportSuite(const ExportOptions& options, const OnProgress& on_progress);

/// The layout version of a data set, stored as the key `data_set` of its manifest. A data set whose manifest lacks this
/// key has version 1; its pictures are PNG files.
constexpr int kDataSetVersion = 2;

/// Deletes the temporary folder that a killed export to `output` left.
void RemoveUnfinishedExport(const std::filesystem::path& output);

}  // namespace etude
