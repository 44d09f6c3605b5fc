#include "bench/run/secret_key.h"

#include <unistd.h>

#include <cstdlib>
#include <cstring>

#include "io/files/files.h"
#include "io/process/closed_environment.h"

namespace etude {
namespace {

constexpr const char* kAllowed = "64 hexadecimal digits, or 32 bytes";

/// Returns the first 16 digits of a key's digest, which suffice to distinguish keys.
std::string Short(const Seed& seed) { return seed.Digest().substr(0, 16) + "…"; }

Result<Words256> ParseKey(std::string_view bytes) {
  Words256 words{};
  if (bytes.size() == sizeof words) {
    std::memcpy(words.data(), bytes.data(), sizeof words);
    return words;
  }
  while (!bytes.empty() && (bytes.back() == '\n' || bytes.back() == '\r')) bytes.remove_suffix(1);
  return ParseWords256(bytes);
}

}  // namespace

Result<std::optional<SecretKey>> FindSecretKey(const std::string& file) {
  if (!file.empty()) {
    ASSIGN_OR_RETURN(const auto bytes, ReadWholeFile(file));
    const auto words = ParseKey(bytes);
    if (!words) return Fail({file}, "found {} bytes that are not a key; allowed: {}", bytes.size(), kAllowed);
    std::error_code error;
    if (std::filesystem::hard_link_count(file, error) > 1 && !error) {
      return Fail(
          {file},
          "has a second name (a hard link), through which a program could read the key; allowed: a copy of the file");
    }
    return SecretKey{*words, std::filesystem::absolute(file, error).lexically_normal()};
  }
  char* text = std::getenv(kKeyVariable);
  if (text == nullptr) return std::nullopt;
  const auto words = ParseWords256(text);
  // Erases the key, because other processes can read this process's environment.
  std::memset(text, '0', std::strlen(text));
  ::unsetenv(kKeyVariable);
  if (!words) return Fail({kKeyVariable}, "contains no key; allowed: 64 hexadecimal digits");
  return SecretKey{*words, ""};
}

Result<void> CheckSecretWorlds(int version, const Place& place) {
  if (version == kSecretWorldsVersion) return {};
  return Fail(place,
              "contains secret worlds of version {}, but this program makes version {} (separate random numbers for "
              "each condition); use the etude that made these worlds",
              version, kSecretWorldsVersion);
}

Result<void> OpenSeeds(const std::optional<SecretKey>& key, const Place& place, SuiteSetup& suite) {
  if (suite.seed.IsPlain()) {
    if (!key || key->file.empty()) return {};
    return Fail(place, "has the public seed {}; leave out --seed-file", suite.seed.number());
  }
  if (!key) return Fail(place, "has secret worlds; give the key with the digest {} by --seed-file", Short(suite.seed));
  const Seed seed = Seed::Secret(key->words);
  if (seed.WithoutKey() != suite.seed.WithoutKey()) {
    return Fail(place, "has secret worlds of the key with digest {}, but the given key has digest {}",
                Short(suite.seed), Short(seed));
  }
  RETURN_IF_ERROR(CheckSecretWorlds(suite.secret_worlds, place));
  suite.seed = seed;
  for (ScenarioSetup& scenario : suite.scenarios) scenario.seed = seed;
  return {};
}

}  // namespace etude
