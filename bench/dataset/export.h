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
  std::optional<std::uint64_t> seed;   ///< else each scenario's own, else 1
  std::optional<SecretKey> key = {};   ///< of secret worlds, in the place of a seed
  bool reuse_key = false;              ///< take a key that was used before (used_keys.h)
  std::optional<int> trials;           ///< else each scenario's own
  std::vector<std::string> clips;      ///< replaces the scenarios' clips when not empty
  std::string joint_map;               ///< replaces the scenarios' joint maps when not empty
  std::string clip_facts = {};         ///< RunOptions::clip_facts
  bool films = false;                  ///< of each camera of a capture, beside its pictures
  std::string output;
  std::string program_version;
};

struct ExportOutcome {
  std::size_t problems = 0;
  std::size_t skipped = 0;  ///< worlds in which no method can run; listed with the reason
};

/// Writes the problems of all worlds, and apart from them what is true about them (docs/datasets.md):
///
///     manifest.json                                what makes the same worlds again: as of a run
///     README.md
///     inputs/index.csv                             a line per world
///     inputs/SCENARIO/CONDITION/setting.json       what the problems of a condition share
///     inputs/SCENARIO/CONDITION/TRIAL/problem.json, with its files beside
///     truth/SCENARIO/CONDITION/TRIAL/truth.json, with its files beside
///
/// Secret worlds stand under names, and in an order, that tell nothing of their trials; the index leaves out trial and
/// clip. Whole or not at all, and on its disk. Refused, before anything is written: a folder that holds something, or
/// that another export is writing. The process is to be in the pinned environment, which makes the pictures the same on
/// every machine. `on_progress` is told of thirds of worlds: problems made,
/// written with their films, truths written.
Result<ExportOutcome> ExportSuite(const ExportOptions& options, const OnProgress& on_progress);

/// Takes away what an export to this folder has left that was killed.
void RemoveUnfinishedExport(const std::filesystem::path& output);

}  // namespace etude
