#pragma once

#include <filesystem>
#include <string>

#include "bench/run/plan.h"
#include "bench/run/secret_key.h"
#include "io/files/json.h"

namespace etude {

/// A command that uses a secret key to make worlds.
struct KeyUse {
  std::string command;  ///< "run", "export", "score", "replay"
  std::string suite;
  std::string manifest;  ///< the result of DigestOfRun
  Shard shard = {};
  std::filesystem::path folder;  ///< the folder that the command wrote
  bool continues = false;        ///< true: it resumes a run (`--resume`), which the list must contain
  bool repeats = false;          ///< true: it repeats a run (`--from`) whose earlier runs may have used the key
};

/// Returns a digest of a manifest. It is the same for all shards of a run, and does not depend on the libraries.
std::string DigestOfRun(const Json& manifest);

/// Fails if the key is in its list of uses, KEYFILE.used, because programs that were asked in its worlds may know them.
/// Other shards of the same run may use the key. Fails also if the list cannot be read or written. A key from the
/// environment or from a pipe has no list and is not checked.
Result<void> CheckUnused(const SecretKey& key, const KeyUse& use);

/// Adds a use to the list after checking again, because two runs may begin at the same time. When this function
/// returns, the list is on the disk. With `may_be_used`, nothing is checked, and it is no error if the list cannot be
/// written.
Result<void> NoteUse(const SecretKey& key, const KeyUse& use, bool may_be_used);

/// Adds the use by a replay to the key's list if it is not there yet. A replay is a use, because the programs that the
/// manifest names learn the key's worlds in it. Fails if the list cannot be written.
Result<void> NoteRepeat(const SecretKey& key, const KeyUse& use);

}  // namespace etude
