#pragma once

#include <filesystem>
#include <string>

#include "bench/gate/finished_run.h"

namespace etude {

/// The version of the layout of a baseline file, raised when old readers would fail.
constexpr int kBaselineSchema = 2;
/// The last version that had no seal. It is read, and Snapshot::unsealed says so.
constexpr int kUnsealedSchema = 1;

/// The way in which a reader treats a baseline that is another than its seal says.
enum class BaselineSeal {
  kMustHold,  ///< refuses it
  kMayBreak,  ///< reads it, and says so in Snapshot::unsealed
};

/// A snapshot as JSON, one line per scenario and per method × metric, in the order of the run, so that a
/// version control system shows what moved. Numbers have the digits that read back the same. In the end stands its
/// seal, a digest of all its values: it finds what was edited, and is no signature.
Result<std::string> WriteBaseline(const Snapshot& snapshot);

/// Reads it. Fails, with the line where it can, when anything is missing, not asked for, there twice (keys, too), of
/// another kind, schema or length than it must be, of a letter or metric that nobody knows, null beyond the number of
/// nulls that the line tells, or when all cells of a method failed: of each of these a gate would see less than it
/// says. Last, when it is another than its seal says.
Result<Snapshot> ReadBaseline(const std::string& text, const std::string& file,
                              BaselineSeal seal = BaselineSeal::kMustHold);
Result<Snapshot> LoadBaseline(const std::filesystem::path& path, BaselineSeal seal = BaselineSeal::kMustHold);

}  // namespace etude
