#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// The name of the file that seals a complete run: it holds the digests of all files that the run or merge wrote.
constexpr const char* kSealFile = "seal.json";
/// The names of the files that exist if the owner has signed the run (signature.h).
constexpr const char *kSignedFile = "signed.b2", *kSignatureFile = "signed.b2.minisig";
/// The name of the lock file, which is locked by the process that writes into the folder. It is not a result.
constexpr const char* kLockFile = "lock";

/// Returns true if a part of a result folder is made from results and therefore not sealed: `report`, `video`, `blind`.
bool IsMadeFromResults(std::string_view part);

/// Writes `seal.json`, which holds the XXH3 digest of every file in the folder except `seal.json`, signatures, the
/// journal, the lock file and parts that are made from results. A seal detects accidental changes; it is not a
/// signature.
///
///     {"format": "etude-seal", "version": 1, "files": {"cells.jsonl": "0123456789abcdef", …}}
Result<void> SealRun(const std::filesystem::path& folder);

/// Fails, naming the file, at the first file that is changed, missing or additional. Fails also if there is no seal.
Result<void> CheckSeal(const std::filesystem::path& folder);

/// Returns the names of the sealed files, sorted. Fails if there is no seal.
Result<std::vector<std::string>> SealedNames(const std::filesystem::path& folder);

}  // namespace etude
