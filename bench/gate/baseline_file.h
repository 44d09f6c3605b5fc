#pragma once

#include <filesystem>
#include <string>

#include "bench/gate/snapshot.h"

namespace etude {

/// The version of the layout of a baseline file, raised when old readers would fail.
constexpr int kBaselineSchema = 1;

/// A snapshot as JSON, one line per scenario and per method × metric, in the order of the run, so that a
/// version control system shows what moved. Numbers have the digits that read back the same.
Result<std::string> WriteBaseline(const Snapshot& snapshot);

/// Reads it. Fails with the path within, when anything is missing, of another schema, of another length than
/// the trials, or of a letter or metric that nobody knows.
Result<Snapshot> ReadBaseline(const std::string& text, const std::string& file);
Result<Snapshot> LoadBaseline(const std::filesystem::path& path);

}  // namespace etude
