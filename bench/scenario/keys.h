#pragma once

#include <string>
#include <vector>

#include "bench/keys/key_info.h"

namespace etude {

/// The keys of one kind of mapping in a scenario file.
struct KeyGroup {
  /// The place of the mapping in a file: "expect[]" = an item of the list at `expect`; "" = the top level.
  std::string path;
  std::string title;  ///< title of the mapping, e.g. "An expectation"
  std::vector<KeyInfo> keys;
};

/// Returns every key that a scenario file may contain: first the keys of all scenarios, then the keys of each task and
/// of its methods.
std::vector<KeyGroup> AllKeyGroups();

/// Returns AllKeyGroups as the text of the reference page docs/reference/keys.md.
std::string KeysAsMarkdown();
/// Returns AllKeyGroups as the JSON Schema docs/schemas/scenario.schema.json. Editors use it to complete and check
/// scenario files.
std::string KeysAsSchema();

}  // namespace etude
