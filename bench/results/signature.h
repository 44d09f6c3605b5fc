#pragma once

#include <filesystem>
#include <string>

#include "engine/base/result.h"

namespace etude {

/// The signature of a run by its owner. A seal finds mistakes; whoever forges a run can seal it, but not sign it.
///
///     signed.b2          the BLAKE2b digest of seal.json and of every sealed file, as `b2sum` writes and checks it
///     signed.b2.minisig  the signature of that file, as `minisign -S` writes and `minisign -V` checks it (Ed25519)

/// Writes both into the folder of a sealed run. `secret_key` is a file that `minisign -G -W` made; one with a password
/// is refused.
Result<void> SignRun(const std::filesystem::path& folder, const std::string& secret_key);

/// Checks both. `public_key` is minisign's file, or its text (RW…). Fails naming the first file that is not as it was
/// signed. Gives the number of the key, by which minisign names it.
Result<std::string> CheckSignature(const std::filesystem::path& folder, const std::string& public_key);

}  // namespace etude
