#pragma once

#include <filesystem>
#include <string>

#include "bench/run/plan.h"
#include "bench/run/secret_key.h"
#include "io/files/json.h"

namespace etude {

/// What threw dice under a secret key.
struct KeyUse {
  std::string command;  ///< "run", "export", "score", "replay"
  std::string suite;
  std::string manifest;  ///< DigestOfRun
  Shard shard = {};
  std::filesystem::path folder;  ///< that it wrote
  bool continues = false;        ///< it goes on with a run (`--resume`), which the list must tell of
  bool repeats = false;          ///< it repeats a run (`--from`): runs of the same manifest may have used the key
};

/// A digest of a manifest that shards of one run share, whatever libraries they run under.
std::string DigestOfRun(const Json& manifest);

/// Refuses a key that stands in the list of used keys, KEYFILE.used: whoever was asked in those worlds may know them. A
/// shard may use the key of the run's other shards. Refused, too: a list that cannot be read or written. A key from
/// the environment or a pipe has no list.
Result<void> CheckUnused(const SecretKey& key, const KeyUse& use);

/// Adds a use to the list, on the disk when this returns; checks it again, since two runs may begin at the same time.
/// With `may_be_used` nothing is refused, and a list that cannot be written is left as it is.
Result<void> NoteUse(const SecretKey& key, const KeyUse& use, bool may_be_used);

/// Notes that cells of a run are run again by programs that its manifest names, whoever wrote that: of a key that the
/// list has not, what they are asked is new to everybody. Refused where that cannot be written.
Result<void> NoteRepeat(const SecretKey& key, const KeyUse& use);

}  // namespace etude
