#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bench/run/setup.h"

namespace etude {

/// The key of secret worlds, and the file that it was read from; "" = the environment.
struct SecretKey {
  Words256 words{};
  std::filesystem::path file;
};

/// Reads the key from `file`, as 64 hexadecimal digits or 32 raw bytes; if `file` is "", from the environment variable
/// ETUDE_SEED_KEY, whose value is then erased. Returns nullopt if there is neither. Error messages never show the
/// content.
Result<std::optional<SecretKey>> FindSecretKey(const std::string& file);

/// Fails if secret worlds have another version than this program makes.
Result<void> CheckSecretWorlds(int version, const Place& place);

/// Sets the key of a suite's secret seeds; `place` is where the suite was read from. Fails if the key is missing, if it
/// has another digest, or if a key file is given for plain seeds.
Result<void> OpenSeeds(const std::optional<SecretKey>& key, const Place& place, SuiteSetup& suite);

}  // namespace etude
