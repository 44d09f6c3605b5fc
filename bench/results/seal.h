#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// The seal of a whole run: the digests of all files that the run or merge wrote.
constexpr const char* kSealFile = "seal.json";
/// Present if the owner has signed the run (signature.h).
constexpr const char *kSignedFile = "signed.b2", *kSignatureFile = "signed.b2.minisig";
/// The lock of the process that writes into the folder; not a result.
constexpr const char* kLockFile = "lock";

/// Returns true for a part of a result folder that is made from results and is not sealed: `report`, `video`.
bool IsMadeFromResults(std::string_view part);

/// Writes `seal.json`: the XXH3 digest of every file in the folder except itself, signatures, the journal and parts
/// that are made from results. It detects accidental changes; it is not a signature.
///
///     {"format": "etude-seal", "version": 1, "files": {"cells.jsonl": "0123456789abcdef", …}}
Result<void> SealRun(const std::filesystem::path& folder);

/// Fails, naming the file, at the first file that is changed, missing or new, and if there is no seal.
Result<void> CheckSeal(const std::filesystem::path& folder);

/// Returns the names of the sealed files, sorted. Fails if there is no seal.
Result<std::vector<std::string>> SealedNames(const std::filesystem::path& folder);

}  // namespace etude
