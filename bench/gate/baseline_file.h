#pragma once

#include <filesystem>
#include <string>

#include "bench/gate/finished_run.h"

namespace etude {

/// The version of the layout of a baseline file; raised if old readers would fail.
constexpr int kBaselineSchema = 2;
/// The last version without a seal. It can be read; Snapshot::unsealed then says so.
constexpr int kUnsealedSchema = 1;

/// What a reader does with a baseline that does not match its seal.
enum class BaselineSeal {
  kMustHold,  ///< complains of it
  kMayBreak,  ///< reads it, and says so in Snapshot::unsealed
};

/// Returns a snapshot as JSON, one line per scenario and per method × metric, in the order of the run, so that a
/// version control system shows what moved. Numbers have the digits that read back the same. At the end is its seal, a
/// digest of all values: it detects edits, but is not a signature.
Result<std::string> WriteBaseline(const Snapshot& snapshot);

/// Reads a baseline. Because a gate would otherwise check less than it says, it fails, with the line if possible, on
/// anything that is missing, unknown or duplicate (keys too); on a wrong kind, schema or length; on an unknown status
/// letter or metric; on more nulls than the line declares; and if all cells of a method failed. Last, it fails on a
/// broken seal.
Result<Snapshot> ReadBaseline(const std::string& text, const std::string& file,
                              BaselineSeal seal = BaselineSeal::kMustHold);
Result<Snapshot> LoadBaseline(const std::filesystem::path& path, BaselineSeal seal = BaselineSeal::kMustHold);

}  // namespace etude
