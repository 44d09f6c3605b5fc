#pragma once

#include <filesystem>
#include <string>

#include "bench/run/plan.h"
#include "bench/run/secret_key.h"
#include "io/files/json.h"

namespace etude {

/// A command that uses a secret key to make worlds.
struct KeyUse {
  std::string command;  ///< name of the command: "run", "export", "score", "replay"
  std::string suite;
  std::string manifest;  ///< digest of the manifest (DigestOfRun)
  Shard shard = {};
  std::filesystem::path folder;  ///< the folder into which the command writes
  bool continues = false;        ///< true: the command resumes a run (`--resume`), whose use is already listed
  /// True: the command repeats a run (`--from`), so the key may have been used for this run before.
  bool repeats = false;
};

/// Returns a digest of a manifest. The digest is the same for all shards of a run, and does not depend on the
/// libraries.
std::string DigestOfRun(const Json& manifest);

/// Fails if the list of the key's uses, KEYFILE.used, already contains a use, because outside programs may have learned
/// the key's worlds. A use by another shard of the same run is allowed. Fails also if the list cannot be read or
/// written. A key from the environment or from a pipe has no list and is not checked.
Result<void> CheckUnused(const SecretKey& key, const KeyUse& use);

/// Adds a use to the list after checking again, because two runs may begin at the same time. When this function
/// succeeds, the list is on the disk. With `may_be_used`, nothing is checked. With `may_be_used`, or if the command
/// resumes or repeats a run, a use that is already listed is not added again, and a list that cannot be written is not
/// an error.
Result<void> NoteUse(const SecretKey& key, const KeyUse& use, bool may_be_used);

/// Adds the use by a replay to the list of the key's uses, unless the list already contains a use of this key. A replay
/// is a use, because the outside programs that the manifest names may learn the key's worlds. Fails if the list cannot
/// be written.
Result<void> NoteRepeat(const SecretKey& key, const KeyUse& use);

}  // namespace etude
