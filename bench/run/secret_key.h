#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bench/run/setup.h"

namespace etude {

/// The key of secret worlds, and the file from which it was read; the file is "" if the key came from the environment.
struct SecretKey {
  Words256 words{};
  std::filesystem::path file;
};

/// Reads the key from `file`, which contains 64 hexadecimal digits or 32 raw bytes. If `file` is "", reads the key from
/// the environment variable ETUDE_SEED_KEY and erases the variable's value. Returns nullopt if `file` is "" and the
/// variable does not exist. Fails if the key has another form, or if `file` has a second hard link. Error messages
/// never show the key.
Result<std::optional<SecretKey>> FindSecretKey(const std::string& file);

/// Secret worlds are made by a rule with a version. Fails if `version` differs from the version of this program.
Result<void> CheckSecretWorlds(int version, const Place& place);

/// Puts the key into the secret seeds of a suite. `place` is the suite's position for error messages. Fails if the key
/// is missing, if its digest is not the one in the suite, or if a key file is given although no seed is secret.
Result<void> OpenSeeds(const std::optional<SecretKey>& key, const Place& place, SuiteSetup& suite);

}  // namespace etude
