#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bench/run/setup.h"

namespace etude {

/// The key of secret worlds, and the file that it was read from: "" = the environment.
struct SecretKey {
  Words256 words{};
  std::filesystem::path file;
};

/// Reads `file`, 64 hexadecimal digits or 32 bytes as they are; without one the variable ETUDE_SEED_KEY, which is
/// blotted out then. Nothing where there is neither. No complaint shows what was found.
Result<std::optional<SecretKey>> FindSecretKey(const std::string& file);

/// Refuses secret worlds of another version than this program makes.
Result<void> CheckSecretWorlds(int version, const Place& place);

/// Opens the seeds of a suite that was read from `place`. A secret one needs its own key; other keys are refused by
/// their digests, and so is the key of a file where the seeds are plain.
Result<void> OpenSeeds(const std::optional<SecretKey>& key, const Place& place, SuiteSetup& suite);

}  // namespace etude
