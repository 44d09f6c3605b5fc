#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// The seal in the folder of a whole run: a digest of every file that the run or the merge wrote.
constexpr const char* kSealFile = "seal.json";
/// Stand beside it where its owner has signed the run (signature.h).
constexpr const char *kSignedFile = "signed.b2", *kSignatureFile = "signed.b2.minisig";
/// Locked by whoever writes into the folder, and gone when it is done; no result.
constexpr const char* kLockFile = "lock";

/// True if a part of a result folder is made from the results, and may be made again: `report`, `video`. Such parts are
/// not sealed.
bool IsMadeFromResults(std::string_view part);

/// Writes `seal.json`: the XXH3 digest of every file in the folder, but for itself, signatures, the journal and what is
/// made from results. It finds mistakes, of disks and of people; it is no signature.
///
///     {"format": "etude-seal", "version": 1, "files": {"cells.jsonl": "0123456789abcdef", …}}
Result<void> SealRun(const std::filesystem::path& folder);

/// Fails naming the first file that is not as the run wrote it, is missing, or came later; and when there is no seal.
Result<void> CheckSeal(const std::filesystem::path& folder);

/// The names of the files that the seal of a folder tells of, ascending. Fails when there is no seal.
Result<std::vector<std::string>> SealedNames(const std::filesystem::path& folder);

}  // namespace etude
