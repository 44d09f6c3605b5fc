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
  std::vector<std::string> scenarios;  ///< files, or folders of *.yaml
  std::optional<std::uint64_t> seed;   ///< default: each scenario's own, else 1
  std::optional<SecretKey> key = {};   ///< of secret worlds, instead of a seed
  bool reuse_key = false;              ///< allow a key that was used before (used_keys.h)
  std::optional<int> trials;           ///< default: each scenario's own
  std::vector<std::string> clips;      ///< if not empty, replaces the scenarios' clips
  std::string joint_map;               ///< if not empty, replaces the scenarios' joint maps
  std::string clip_facts = {};         ///< RunOptions::clip_facts
  bool films = false;                  ///< also write a film of each camera of a capture
  std::string output;
  std::string program_version;
};

struct ExportOutcome {
  std::size_t problems = 0;
  std::size_t skipped = 0;  ///< worlds in which no method can run; listed with the reason
};

/// Writes the problems of all worlds and, separately, their truths (docs/datasets.md):
///
///     manifest.json                                what makes the same worlds again: as of a run
///     README.md
///     inputs/index.csv                             a line per world
///     inputs/SCENARIO/CONDITION/setting.json       what the problems of a condition share
///     inputs/SCENARIO/CONDITION/TRIAL/problem.json, with its files beside
///     truth/SCENARIO/CONDITION/TRIAL/truth.json, with its files beside
///
/// Secret worlds have names, and an order, that reveal nothing of their trials; the index then leaves out trial and
/// clip. The data set is written completely, and synced to disk, or not at all. A non-empty folder, and one that
/// another export is writing, are errors before anything is written. The process must be in the pinned environment, so
/// that pictures are the same on every machine. `on_progress` counts thirds of worlds: problem made, problem written
/// with its films, truth written.
Result<ExportOutcome> ExportSuite(const ExportOptions& options, const OnProgress& on_progress);

/// Removes what a killed export to this folder has left.
void RemoveUnfinishedExport(const std::filesystem::path& output);

}  // namespace etude
