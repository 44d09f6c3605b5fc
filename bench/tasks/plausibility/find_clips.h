#pragma once

#include <map>
#include <span>
#include <string>

#include "bench/tasks/base/task.h"

namespace etude {

/// TaskKind::find_files of task plausibility. A folder stands for the motion files in it, a file of several clips for
/// each of them. Clips of one name of several methods are one world; a name is the file's, with the folders that a
/// pattern's wildcards stand for and without extension, and the clip behind '#'. If a method has several of one name,
/// each is named with its extension. Worlds are sorted by name. Fails if a method's files still have one name, and for
/// more than kMaxPairs files.
Result<FoundFiles> FindLoneClips(const Node& condition, std::span<const Node> methods,
                                 const std::map<std::string, std::string>& texts);

}  // namespace etude
