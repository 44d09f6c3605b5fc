#pragma once

#include <filesystem>
#include <string>

#include "bench/run/plan.h"
#include "bench/run/secret_key.h"
#include "io/files/json.h"

namespace etude {

/// A use of a secret key to make worlds.
struct KeyUse {
  std::string command;  ///< "run", "export", "score", "replay"
  std::string suite;
  std::string manifest;  ///< DigestOfRun
  Shard shard = {};
  std::filesystem::path folder;  ///< the folder that the command wrote
  bool continues = false;        ///< it resumes a run (`--resume`), which the list must name
  bool repeats = false;          ///< it repeats a run (`--from`): runs with the same manifest may have used the key
};

/// Returns a digest of a manifest that is the same for all shards of a run, whatever libraries they run under.
std::string DigestOfRun(const Json& manifest);

/// Fails if the key is in the list of used keys, KEYFILE.used: programs that were asked in its worlds may know them.
/// Other shards of the same run may use the key. Fails also if the list cannot be read or written. A key from the
/// environment or a pipe has no list, and is not checked.
Result<void> CheckUnused(const SecretKey& key, const KeyUse& use);

/// Checks again, because two runs may begin at the same time, then adds a use to the list; when this function returns,
/// the list is on the disk. With `may_be_used`, nothing is checked, and it is no error if the list cannot be written.
Result<void> NoteUse(const SecretKey& key, const KeyUse& use, bool may_be_used);

/// Adds the key to its list, if it is not there: a replay asks programs that the manifest names, and these learn the
/// worlds. Fails if the list cannot be written.
Result<void> NoteRepeat(const SecretKey& key, const KeyUse& use);

}  // namespace etude
