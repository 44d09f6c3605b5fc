#pragma once

#include <filesystem>
#include <string>

#include "bench/gate/finished_run.h"

namespace etude {

/// The version of the format of a baseline file. It is raised when older programs can no longer read the file.
constexpr int kBaselineSchema = 2;
/// The last format version without a seal. ReadBaseline reads such a file only with BaselineSeal::kMayBreak, and then
/// sets Snapshot::unsealed.
constexpr int kUnsealedSchema = 1;

/// The action of ReadBaseline if a baseline does not match its seal, or has no seal.
enum class BaselineSeal {
  kMustHold,  ///< ReadBaseline fails
  kMayBreak,  ///< ReadBaseline succeeds and sets Snapshot::unsealed
};

/// Returns a snapshot as JSON, in the order of the run. Each scenario, and each metric of each method, is on a line of
/// its own, so that version control shows what changed. Numbers keep their exact values when they are read again. The
/// last key is the seal, a digest of all values: it reveals edits but is not a signature.
Result<std::string> WriteBaseline(const Snapshot& snapshot);

/// Reads a baseline strictly, because a gate with an incomplete baseline would check less than it reports. Fails on a
/// missing, unknown or duplicate entry or key; on a wrong type, schema or length; on an unknown status letter or
/// metric; if the number of nulls is not the declared one; if no cell has an answer (ok or unsolved); if a method has
/// no answer under a condition, although not all of these cells were skipped; and on a broken seal (see
/// BaselineSeal). The error names the line if possible.
Result<Snapshot> ReadBaseline(const std::string& text, const std::string& file,
                              BaselineSeal seal = BaselineSeal::kMustHold);
Result<Snapshot> LoadBaseline(const std::filesystem::path& path, BaselineSeal seal = BaselineSeal::kMustHold);

}  // namespace etude
