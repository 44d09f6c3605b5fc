#pragma once

#include <map>
#include <span>
#include <string>

#include "bench/tasks/base/task.h"

namespace etude {

/// Finds the worlds of task plausibility (TaskKind::find_files), sorted by name. A folder stands for the motion files
/// in it, and a file with several clips stands for each of these clips. Clips of several methods that have the same
/// name are one world. A clip is named after its file, without extension: "walk". If the file has several clips, '#'
/// and the clip follow: "walk#Ann". The folders for which a pattern's wildcards stand are put in front: "day1/walk".
/// If a method has several clips of one name, their names include the extension. Fails if a method's clips still have
/// the same name, or if there are more than kMaxPairs clips.
Result<FoundFiles> FindLoneClips(const Node& condition, std::span<const Node> methods,
                                 const std::map<std::string, std::string>& texts);

}  // namespace etude
