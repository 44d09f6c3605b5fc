#pragma once

#include <filesystem>
#include <string>

#include "engine/base/result.h"

namespace etude {

/// These functions sign a run for its owner and check the signature. A seal detects errors; a forger can renew the
/// seal, but not the signature.
///
///     signed.b2          the BLAKE2b digests of seal.json and of every sealed file, in the format of `b2sum`
///     signed.b2.minisig  the Ed25519 signature of signed.b2, in the format of `minisign -S` and `minisign -V`

/// Signs a sealed run with the secret key in the file `secret_key`, made by `minisign -G -W`. Fails if the key has a
/// password.
Result<void> SignRun(const std::filesystem::path& folder, const std::string& secret_key);

/// Checks the signature and all files. `public_key` is the path of a file with a public key of minisign, or the key
/// itself as text ("RW…"). Returns the key ID as minisign shows it. Fails, naming the file, at the first file that was
/// changed after the run was signed.
Result<std::string> CheckSignature(const std::filesystem::path& folder, const std::string& public_key);

}  // namespace etude
