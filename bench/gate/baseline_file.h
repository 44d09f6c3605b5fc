#pragma once

#include <filesystem>
#include <string>

#include "bench/gate/finished_run.h"

namespace etude {

/// The version of the format of a baseline file. It is raised when older programs could no longer read the file.
constexpr int kBaselineSchema = 2;
/// The last version of the format without a seal. ReadBaseline still reads it, and Snapshot::unsealed then says that
/// the seal is missing.
constexpr int kUnsealedSchema = 1;

/// What to do if a baseline does not match its seal.
enum class BaselineSeal {
  kMustHold,  ///< the reader fails
  kMayBreak,  ///< the baseline is read, and Snapshot::unsealed is set
};

/// Returns a snapshot as JSON, in the order of the run. Each scenario and each method × metric has a line of its own,
/// so that version control shows what changed. Numbers read back unchanged. The last key is the seal, a digest of all
/// values: it detects edits but is not a signature.
Result<std::string> WriteBaseline(const Snapshot& snapshot);

/// Reads a baseline strictly, because a gate with an incomplete baseline would check less than it reports. Fails on a
/// missing, unknown or duplicate entry or key; on a wrong type, schema or length; on an unknown status letter or
/// metric; if the number of nulls is not the declared one; if no cell is ok or unsolved; and on a broken seal. The
/// error names the line if possible.
Result<Snapshot> ReadBaseline(const std::string& text, const std::string& file,
                              BaselineSeal seal = BaselineSeal::kMustHold);
Result<Snapshot> LoadBaseline(const std::filesystem::path& path, BaselineSeal seal = BaselineSeal::kMustHold);

}  // namespace etude
