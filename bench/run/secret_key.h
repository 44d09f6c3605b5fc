#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bench/run/setup.h"

namespace etude {

/// The key of secret worlds, and the file from which it was read; "" = the environment.
struct SecretKey {
  Words256 words{};
  std::filesystem::path file;
};

/// Reads the key from `file`, which holds 64 hexadecimal digits or 32 raw bytes. If `file` is "", reads it from the
/// environment variable ETUDE_SEED_KEY and erases the variable's value. Returns nullopt if both are empty. Error
/// messages never show the key.
Result<std::optional<SecretKey>> FindSecretKey(const std::string& file);

/// Fails if `version` of the rule that makes secret worlds is not the version of this program.
Result<void> CheckSecretWorlds(int version, const Place& place);

/// Sets the key of a suite's secret seeds. `place` is the place of the suite, for errors. Fails if the key is missing,
/// if it has another digest, or if a key file is given although all seeds are plain.
Result<void> OpenSeeds(const std::optional<SecretKey>& key, const Place& place, SuiteSetup& suite);

}  // namespace etude
