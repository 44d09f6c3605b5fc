#pragma once

#include <filesystem>
#include <string>

#include "bench/gate/finished_run.h"

namespace etude {

/// The version of the format of a baseline file; raised if old readers would fail.
constexpr int kBaselineSchema = 2;
/// The last version without a seal. It can be read; Snapshot::unsealed then says so.
constexpr int kUnsealedSchema = 1;

/// What to do if a baseline does not match its seal.
enum class BaselineSeal {
  kMustHold,  ///< fail
  kMayBreak,  ///< read it, and set Snapshot::unsealed
};

/// Returns a snapshot as JSON, in the order of the run: one line per scenario and per method × metric, so that version
/// control shows what moved. Numbers read back the same. The last key is the seal, a digest of all values; it detects
/// edits but is not a signature.
Result<std::string> WriteBaseline(const Snapshot& snapshot);

/// Reads a baseline strictly, because a gate with an incomplete baseline would check less than it reports. Fails, with
/// the line if possible, on anything missing, unknown or duplicate (keys too); on a wrong type, schema or length; on an
/// unknown status letter or metric; if the number of nulls is not the declared one; if all cells of a method failed;
/// and last on a broken seal.
Result<Snapshot> ReadBaseline(const std::string& text, const std::string& file,
                              BaselineSeal seal = BaselineSeal::kMustHold);
Result<Snapshot> LoadBaseline(const std::filesystem::path& path, BaselineSeal seal = BaselineSeal::kMustHold);

}  // namespace etude
